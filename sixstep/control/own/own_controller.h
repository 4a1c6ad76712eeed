/* SPDX-License-Identifier: Apache-2.0 */
/* A controller of one's own: what it must be to stand in a scenario, in a comparison and on a chip beside the library's. Plain C,
 * so that it may be written in whatever makes a C symbol; own_controller.hpp makes one of a C++ class.
 *
 * A file with one of these is compiled into a shared object,
 *
 *   cc -O2 -ffp-contract=off -shared -fPIC -I SIXSTEP mine.c -o mine.so
 *
 * and a scenario names it: control.drive = "own", control.own.controller = "mine.so" (docs/howto/write-a-controller.md).
 *
 * The same source goes onto a chip in float: numbers are sixstep_real, double for the program, and what SIXSTEP_REAL names
 * (-DSIXSTEP_REAL=float) else. A literal like 0.5 is a double: written (sixstep_real)0.5, a chip computes with it in float.
 * tools/own_cost.sh counts what it takes there.
 *
 * What it computes must depend on nothing but config, state and what it is given: runs are repeated, resumed, copied and run side by
 * side. State is moved about as bytes, so it holds no pointer into itself. Nothing here may allocate, block, throw or end the
 * program. */
#ifndef SIXSTEP_CONTROL_OWN_OWN_CONTROLLER_H
#define SIXSTEP_CONTROL_OWN_OWN_CONTROLLER_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifndef SIXSTEP_REAL
#define SIXSTEP_REAL double
#endif
typedef SIXSTEP_REAL sixstep_real;

/* Of these structs: 1 in double, 257 in float. A program refuses what has another than its own. */
#define SIXSTEP_OWN_INTERFACE (1u + (sizeof(sixstep_real) == 8 ? 0u : 256u))

/* What the setpoint means: duty -1..1, A, rad/s, mechanical degrees. */
enum { SIXSTEP_DUTY = 1, SIXSTEP_CURRENT = 2, SIXSTEP_SPEED = 3, SIXSTEP_POSITION = 4 };
enum { SIXSTEP_LEG_A = 0, SIXSTEP_LEG_B = 1, SIXSTEP_LEG_C = 2 };
/* How the off part of a pair's period looks, and which of its switches the duty chops (bridge_command.hpp). */
enum { SIXSTEP_SOFT = 0, SIXSTEP_HARD = 1, SIXSTEP_COMPLEMENTARY = 2 };
enum { SIXSTEP_UPPER = 0, SIXSTEP_LOWER = 1 };
/* What a leg does for a period, and what its pulse turns on (leg_command.hpp). */
enum { SIXSTEP_LEG_OFF = 0, SIXSTEP_LEG_LOW = 1, SIXSTEP_LEG_HIGH = 2, SIXSTEP_LEG_PWM = 3 };
enum { SIXSTEP_PWM_COMPLEMENTARY = 0, SIXSTEP_PWM_UPPER = 1, SIXSTEP_PWM_LOWER = 2, SIXSTEP_PWM_LOWER_FIRST = 3 };
/* What a controller answers with: a driven pair that the board moves on at Hall edges, or three legs. */
enum { SIXSTEP_ANSWERS_PAIR = 0, SIXSTEP_ANSWERS_LEGS = 1 };

/* One sample, as the scenario's sensors have it. */
typedef struct {
  sixstep_real current_A[3]; /* of phases a, b, c, into the motor */
  sixstep_real speed_rad_s;  /* mechanical */
  sixstep_real position_deg; /* mechanical, counted over turns */
  sixstep_real bus_V;
  sixstep_real magnet_cos, magnet_sin; /* of the electrical angle of the magnet from phase a's axis; by Hall codes alone the sector's middle */
  uint8_t hall;                        /* H1 H2 H3 as bits 2, 1, 0, as probes 120 degrees apart show it */
} sixstep_measured;

typedef struct {
  uint8_t state;     /* SIXSTEP_LEG_OFF ... */
  uint8_t switches;  /* of SIXSTEP_LEG_PWM */
  sixstep_real duty; /* 0..1, of SIXSTEP_LEG_PWM */
} sixstep_leg;

/* Answers a pair: source, sink, duty, chopping, chopped. Answers legs: leg. Is zero before the first step and keeps what it was
 * told: all gates off. */
typedef struct {
  uint8_t enabled; /* 0: all six gates off */
  uint8_t fault;   /* not 0: the controller gives up, and the run ends with exit code 3 */
  uint8_t source;  /* leg whose upper switch the current comes by */
  uint8_t sink;    /* leg whose lower switch it leaves by */
  uint8_t chopping, chopped;
  sixstep_real duty;    /* 0..1 */
  sixstep_real overlap; /* of the leg in no pair: its upper switch (below 0: its lower one) chopped, -1..1 */
  sixstep_leg leg[3];
  sixstep_real current_reference_A;   /* for the report alone */
  sixstep_real speed_reference_rad_s; /* alike */
} sixstep_answer;

/* What one may know who designs it: the nominal motor's sheet, the board, and the loops that the library would use for this scenario
 * (gains of u[n] = u[n-1] + d1 e[n] + d0 e[n-1]; 0 where the mode has no such loop). */
typedef struct {
  uint8_t mode;
  uint8_t delay_periods; /* that an answer waits */
  uint8_t sampled_in_middle;
  uint8_t chopping;
  sixstep_real period_s;
  sixstep_real bus_V;
  sixstep_real pole_pairs;
  sixstep_real R_ohm, L_H;             /* of a phase */
  sixstep_real K_t_Nm_A;               /* N m per A of a driven pair, and V s/rad between two terminals */
  sixstep_real magnet_Vs;              /* peak of a phase's flux linkage by the magnet, of a sine machine's */
  sixstep_real J_kg_m2, B_Nm_s;        /* with the load's */
  sixstep_real current_d1, current_d0; /* V per A */
  sixstep_real speed_d1, speed_d0;     /* of the full torque per rad/s */
  sixstep_real full_torque_Nm, full_current_A;
  sixstep_real current_limit_A;
  sixstep_real position_gain_rad_s_per_deg, speed_limit_rad_s; /* of the speed that a position loop asks for */
} sixstep_given;

typedef struct {
  const char* name; /* letters, digits, '_' */
  const char* unit; /* "" for none */
  const char* meaning;
  sixstep_real preset, least, most;
} sixstep_parameter;

typedef struct {
  uint32_t interface; /* SIXSTEP_OWN_INTERFACE */
  uint32_t answers;   /* SIXSTEP_ANSWERS_PAIR or SIXSTEP_ANSWERS_LEGS */
  const char* name;   /* in a few words, for tables */
  const char* sentence; /* what it does otherwise than others: "it ..." */
  uint32_t config_bytes, state_bytes; /* up to 65536 each */
  uint32_t parameters;                /* how many, up to 64 */
  const sixstep_parameter* parameter;
  /* Fills config, which is zero, from what is given and one value per parameter. Answers a null pointer, or what is wrong in half a
   * sentence: "asks for more than the bus has". */
  const char* (*design)(const sixstep_given* given, const sixstep_real* values, void* config);
  /* Fills state, which is zero. May be null. */
  void (*start)(const void* config, void* state);
  /* Once per control period; answer holds the last one. */
  void (*step)(const void* config, void* state, const sixstep_measured* measured, sixstep_real setpoint, sixstep_answer* answer);
  /* In the Hall interrupt, of one that answers a pair: the pair moves on. Null: it moves at the next step. */
  void (*hall)(const void* config, void* state, uint8_t code, sixstep_answer* answer);
} sixstep_controller;

/* The one symbol of the shared object. */
const sixstep_controller* sixstep_own_controller(void);

#ifdef __cplusplus
}
#endif

#endif
