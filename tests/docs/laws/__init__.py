# SPDX-License-Identifier: Apache-2.0
"""What must be true of the numbers that the pages print, apart from being what the program prints: bounds from physics, closed
forms, sums, and a second way. published_numbers_test.py finds the numbers and asks the law that stands for them."""
