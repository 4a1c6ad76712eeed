/* SPDX-License-Identifier: Apache-2.0 */
/* A shared object without the controller's function. */
int somebody_elses(void) { return 1; }
