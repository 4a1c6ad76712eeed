/* SPDX-License-Identifier: Apache-2.0 */
/* A drive as a functional mock-up unit: the part that FMI 2.0 and 3.0 have in common. It uses only sixstep.h. fmi2.c
 * and fmi3.c check the order of calls and translate names. plant.c adds the functions of a unit without controller.
 * The language is C99.
 *
 * Resources of the unit: scenario.toml with its motor, and variables.txt, which lists the variables by reference.
 * A changed input acts at the first control tick at or after the communication point; gates act at the communication
 * point itself. */
#ifndef SIXSTEP_FMU_DRIVE_H
#define SIXSTEP_FMU_DRIVE_H

#include <stddef.h>
#include <stdint.h>

#include "faces/c/sixstep.h"

typedef enum { DRIVE_OK, DRIVE_DISCARD, DRIVE_ERROR } drive_result;

/* Phases of an instance as bits, so that one number can contain several phases. */
typedef enum {
  DRIVE_INSTANTIATED = 1,
  DRIVE_INITIALIZATION = 2,
  DRIVE_STEP_COMPLETE = 4,
  DRIVE_STEP_FAILED = 8,
  DRIVE_TERMINATED = 16,
  DRIVE_EVENT = 32,       /* FMI 3.0 */
  DRIVE_INTERMEDIATE = 64 /* FMI 3.0: within a step, while the importer's callback runs */
} drive_phase;

/* References of variables. The reference of a signal is its index in sixstep.h. References from 1100 on exist only
 * in a unit without controller: inputs for the bridge (plant.h), measurements of the controller, and counts of
 * converters. */
enum {
  DRIVE_SIGNALS = 512,
  DRIVE_FIRST_INPUT = 1000,
  DRIVE_INPUTS = 8,
  DRIVE_FIRST_SET = 1100,
  DRIVE_SETS = 30,
  DRIVE_FIRST_MEASURED = 1200,
  DRIVE_MEASURED = 10,
  DRIVE_FIRST_COUNT = 1300,
  DRIVE_COUNTS = 8,
  DRIVE_REFERENCES = 1400,
  DRIVE_DIGEST = 2000
};

/* Events at which a step can stop, as bits. Below: the references of the FMI 3.0 clocks, and of the parameters that
 * enable a clock. */
enum { DRIVE_TICK = 1, DRIVE_HALL = 2 };
enum { DRIVE_USES_TICKS = 1020, DRIVE_USES_HALL, DRIVE_TICK_CLOCK = 1030, DRIVE_HALL_CLOCK };

enum { DRIVE_MESSAGE = 1024, DRIVE_ARRAY = 6 }; /* size of a message; largest number of values of an array */

typedef enum { DRIVE_NONE, DRIVE_REAL, DRIVE_INTEGER, DRIVE_BOOLEAN } drive_kind;

typedef struct {
  char token[64]; /* token of modelDescription.xml */
  sixstep_chip chip;
  drive_kind kinds[DRIVE_REFERENCES];
  double factors[DRIVE_REFERENCES]; /* factor from the unit in sixstep.h to the variable's unit */
  int counts[DRIVE_REFERENCES];     /* number of values of a reference; the values of an array have consecutive
                                       references */
  int inputs;
  char keys[DRIVE_INPUTS][64]; /* key of an [[at]] table: "load.torque_Nm" */
  double starts[DRIVE_INPUTS];
} drive_variables;

/* State of an instance, or a saved state. */
typedef struct drive_state {
  drive_phase phase;
  double start_s; /* the communication point at which the run is at t = 0 */
  double now_s;   /* the present communication point */
  double stop_s;  /* NaN: no stop time is set */
  double wanted[DRIVE_INPUTS], applied[DRIVE_INPUTS];
  double set[DRIVE_SETS], set_applied[DRIVE_SETS]; /* inputs for the bridge */
  double measured[DRIVE_MEASURED];                 /* at the last control tick */
  double counts[DRIVE_COUNTS];                     /* at the communication point */
  double uses[2];            /* whether the clock is used: of ticks, of Hall edges */
  unsigned active;           /* clocks that tick at the present instant */
  char digest[17];           /* empty until the run is terminated */
  sixstep_session* session;  /* null until the initialization */
  struct drive_state* next;  /* list of the instance's saved states */
} drive_state;

/* `log` receives each message; category: "logStatusError", "logStatusDiscard" or "logEvents". */
typedef struct drive {
  drive_variables variables;
  drive_state state;
  drive_state* saved;
  char scenario[4096]; /* path of the scenario */
  void (*log)(struct drive* self, drive_result status, const char* category, const char* message);
} drive;

/* Logs "where: ..." and returns DRIVE_ERROR. */
drive_result drive_fail(drive* self, const char* where, const char* message);
/* Logs the problems of the session's last call. */
drive_result drive_refused(drive* self, const char* function, const sixstep_session* session);
/* Whether the phase is one of `phases`; else logs an error. */
int drive_allowed(drive* self, const char* function, unsigned phases);

/* Reads the variables. `location`: folder of the resources as a path or as a URI of scheme file. `token` must be
 * equal to the unit's token. */
drive_result drive_read(drive* self, const char* location, const char* token);
/* Frees sessions and saved states. */
void drive_clear(drive* self);
/* Resets the instance to its state after drive_read(). */
void drive_reset(drive* self);

drive_result drive_set_up(drive* self, double start_s, int has_stop, double stop_s);
drive_result drive_initialize(drive* self);
/* Advances to point + size. DRIVE_DISCARD: the run ended before; state.now_s is the instant of its end. */
drive_result drive_step(drive* self, const char* function, double point, double size);
/* Executes drive_step() in parts. drive_begin_step() applies the inputs. drive_go_on() advances to `to`, or to an
 * earlier event of `stops`; *events: the events at the reached instant. plant_look() then reads the counts of
 * converters. */
drive_result drive_begin_step(drive* self, const char* function, double point, double size);
drive_result drive_go_on(drive* self, const char* function, double to, unsigned stops, unsigned* events);
drive_result drive_terminate(drive* self);

/* Number of values of a reference. */
int drive_size(const drive* self, unsigned reference);
/* All values of a reference, drive_size() of them. */
drive_result drive_get(drive* self, const char* function, unsigned reference, drive_kind kind, double* values);
drive_result drive_set(drive* self, const char* function, unsigned reference, drive_kind kind, const double* values);

/* Saved states belong to the instance. A null `*at` is set to a new state. */
drive_result drive_save(drive* self, const char* function, void** at);
drive_result drive_restore(drive* self, const char* function, const void* from);
drive_result drive_forget(drive* self, const char* function, void** at);
/* Number of bytes of a saved state; 0: `of` is no saved state. Writes the bytes if they fit into `room`. */
size_t drive_bytes(drive* self, const void* of, unsigned char* bytes, size_t room);
drive_result drive_from_bytes(drive* self, const char* function, const unsigned char* bytes, size_t count, void** at);

/* Writes a number for sixstep_change() and settings, with a decimal point in any locale. */
void drive_number(char* text, size_t room, double value);

#endif
