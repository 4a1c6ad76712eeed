/* SPDX-License-Identifier: Apache-2.0 */
/* importer BINARY RESOURCES GUID STOP: a simple importer of FMI 2.0 in C. It steps a unit to STOP, returns once to a
 * saved state, and prints the digest. */
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "faces/fmu/fmi2_types.h"

static void* library;

/* ISO C has no cast from an object pointer to a function pointer. */
static void find(const char* name, void* function) {
  void* found = dlsym(library, name);
  if (!found) {
    fprintf(stderr, "%s is missing\n", name);
    exit(2);
  }
  memcpy(function, &found, sizeof found);
}
#define FIND(name)                   \
  __typeof__(fmi2##name)* name##_of; \
  find("fmi2" #name, &name##_of)

static void log_of(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                   fmi2String message, ...) {
  va_list more;
  (void)environment;
  fprintf(stderr, "%s, status %d, %s: ", name, (int)status, category);
  va_start(more, message);
  vfprintf(stderr, message, more);
  va_end(more);
  fputc('\n', stderr);
}

static void check(fmi2Status status, const char* call) {
  if (status == fmi2OK) return;
  fprintf(stderr, "%s returned %d\n", call, (int)status);
  exit(1);
}

int main(int count, char** words) {
  const fmi2CallbackFunctions callbacks = {log_of, calloc, free, NULL, NULL};
  const fmi2ValueReference digest = 2000, speed = 13;
  fmi2FMUstate state = NULL;
  fmi2String text;
  fmi2Real value;
  fmi2Component c;
  double stop, now = 0.0;
  int went_back = 0;
  if (count != 5 || !(library = dlopen(words[1], RTLD_NOW | RTLD_LOCAL))) return 2;
  stop = atof(words[4]);
  FIND(Instantiate);
  FIND(SetupExperiment);
  FIND(EnterInitializationMode);
  FIND(ExitInitializationMode);
  FIND(DoStep);
  FIND(GetReal);
  FIND(GetString);
  FIND(GetFMUstate);
  FIND(SetFMUstate);
  FIND(FreeFMUstate);
  FIND(Terminate);
  FIND(FreeInstance);
  if (!(c = Instantiate_of("drive", fmi2CoSimulation, words[3], words[2], &callbacks, fmi2False, fmi2False))) return 1;
  check(SetupExperiment_of(c, fmi2False, 0, 0, fmi2True, stop), "fmi2SetupExperiment");
  check(EnterInitializationMode_of(c), "fmi2EnterInitializationMode");
  check(ExitInitializationMode_of(c), "fmi2ExitInitializationMode");
  while (now < stop) {
    const double size = now + 1e-4 < stop ? 1e-4 : stop - now;
    check(DoStep_of(c, now, size, fmi2True), "fmi2DoStep");
    check(GetReal_of(c, &speed, 1, &value), "fmi2GetReal");
    now += size;
    if (went_back) continue;
    if (!state && now >= stop / 4) check(GetFMUstate_of(c, &state), "fmi2GetFMUstate");
    if (now >= stop / 2) {
      check(SetFMUstate_of(c, state), "fmi2SetFMUstate");
      check(FreeFMUstate_of(c, &state), "fmi2FreeFMUstate");
      now = 0.0;
      check(GetReal_of(c, (const fmi2ValueReference[]){0}, 1, &now), "fmi2GetReal");
      went_back = 1;
    }
  }
  check(Terminate_of(c), "fmi2Terminate");
  check(GetString_of(c, &digest, 1, &text), "fmi2GetString");
  puts(text);
  FreeInstance_of(c);
  return 0; /* the library stays open, so that a memory checker can print the names of its functions */
}
