/* SPDX-License-Identifier: Apache-2.0 */
/* A shared object that is no controller. */
int somebody_elses(void) { return 1; }
