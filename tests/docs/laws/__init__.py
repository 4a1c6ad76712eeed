# SPDX-License-Identifier: Apache-2.0
"""Laws for the numbers that the pages print. A law does not compare with the program's output. It is a physical
bound, a closed form, a sum, or a second computation. published_numbers_test.py finds the numbers and calls their law."""
