/* SPDX-License-Identifier: Apache-2.0 */
/* Defines the interface of a user's own controller. It runs in a scenario, in a comparison and on a chip,
 * like the library's controllers. The interface is plain C: any language that can define a C symbol can
 * provide a controller. own_controller.hpp makes a controller from a C++ class.
 *
 * A file with a controller is compiled into a shared object,
 *
 *   cc -O2 -ffp-contract=off -shared -fPIC -I SIXSTEP mine.c -o mine.so
 *
 * and a scenario names it: control.drive = "own", control.own.controller = "mine.so"
 * (docs/howto/write-a-controller.md).
 *
 * The same source runs on a chip in float. Numbers are sixstep_real: double in the program, or the type that
 * SIXSTEP_REAL names (-DSIXSTEP_REAL=float). A literal like 0.5 is a double; write (sixstep_real)0.5, so that a
 * chip computes in float. tools/own_cost.sh counts instructions, flash and RAM on the chip.
 *
 * The result must depend only on config, state and the arguments, because the program repeats, resumes and
 * copies runs, and executes several runs at once. State is copied as bytes, so the state must not contain a
 * pointer into itself. No function may allocate, block, throw or end the program. */
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

/* Version of these structs: 1 in double, 257 in float. A program rejects every version except its own. */
#define SIXSTEP_OWN_INTERFACE (1u + (sizeof(sixstep_real) == 8 ? 0u : 256u))

/* Modes, with the unit of the setpoint: duty -1..1, A, rad/s, mechanical degrees. */
enum { SIXSTEP_DUTY = 1, SIXSTEP_CURRENT = 2, SIXSTEP_SPEED = 3, SIXSTEP_POSITION = 4 };
enum { SIXSTEP_LEG_A = 0, SIXSTEP_LEG_B = 1, SIXSTEP_LEG_C = 2 };
/* State of the switches in the off part of a pair's period, and the switch that the duty chops (bridge_command.hpp). */
enum { SIXSTEP_SOFT = 0, SIXSTEP_HARD = 1, SIXSTEP_COMPLEMENTARY = 2 };
enum { SIXSTEP_UPPER = 0, SIXSTEP_LOWER = 1 };
/* State of a leg during a period, and the switches of its pulse (leg_command.hpp). */
enum { SIXSTEP_LEG_OFF = 0, SIXSTEP_LEG_LOW = 1, SIXSTEP_LEG_HIGH = 2, SIXSTEP_LEG_PWM = 3 };
enum { SIXSTEP_PWM_COMPLEMENTARY = 0, SIXSTEP_PWM_UPPER = 1, SIXSTEP_PWM_LOWER = 2, SIXSTEP_PWM_LOWER_FIRST = 3 };
/* Kind of output: a driven pair, which the board changes at Hall edges, or three legs. */
enum { SIXSTEP_ANSWERS_PAIR = 0, SIXSTEP_ANSWERS_LEGS = 1 };

/* One sample of the scenario's sensors. */
typedef struct {
  sixstep_real current_A[3]; /* currents of phases a, b, c, into the motor */
  sixstep_real speed_rad_s;  /* mechanical; for a linear motor m/s */
  /* Mechanical; does not wrap after a full turn. For a linear motor: position in m times 180/pi. */
  sixstep_real position_deg;
  sixstep_real bus_V;
  /* Cosine and sine of the magnet's electrical angle from phase a's axis. With Hall codes only: of the angle of the
   * middle of the sector. */
  sixstep_real magnet_cos, magnet_sin;
  uint8_t hall; /* H1 H2 H3 as bits 2, 1, 0: the code of probes 120 degrees apart */
} sixstep_measured;

typedef struct {
  uint8_t state;     /* SIXSTEP_LEG_OFF ... */
  uint8_t switches;  /* used with SIXSTEP_LEG_PWM */
  sixstep_real duty; /* 0..1, used with SIXSTEP_LEG_PWM */
} sixstep_leg;

/* Output of a step. For a pair set source, sink, duty, overlap, chopping, chopped; for three legs set leg. Before the
 * first step all members are 0 (all gates off); later they contain the last output. */
typedef struct {
  uint8_t enabled; /* 0: all six gates off */
  uint8_t fault;   /* not 0: the controller stops the drive, and the run ends with exit code 3 */
  uint8_t source;  /* leg whose upper switch carries the current to the motor */
  uint8_t sink;    /* leg whose lower switch carries the current back */
  uint8_t chopping, chopped;
  sixstep_real duty;    /* 0..1 */
  sixstep_real overlap; /* -1..1: duty of the third leg's upper switch (below 0: of its lower switch) */
  sixstep_leg leg[3];
  sixstep_real current_reference_A;   /* for the report only */
  sixstep_real speed_reference_rad_s; /* for the report only */
} sixstep_answer;

/* Data for the design: the nominal motor's data sheet, the board, and the loops that the library would use for this
 * scenario. d1 and d0 are the gains of u[n] = u[n-1] + d1 e[n] + d0 e[n-1]; 0 if the mode does not use the loop. */
typedef struct {
  uint8_t mode;
  uint8_t delay_periods; /* number of periods until an output takes effect */
  uint8_t sampled_in_middle;
  uint8_t chopping;
  sixstep_real period_s;
  sixstep_real bus_V;
  sixstep_real pole_pairs;
  sixstep_real R_ohm, L_H;             /* resistance and inductance of a phase */
  sixstep_real K_t_Nm_A;               /* torque constant: N m per A of a driven pair, equal to V s/rad between two terminals */
  sixstep_real magnet_Vs;              /* peak of the flux linkage of the magnet with one phase, fundamental */
  sixstep_real J_kg_m2, B_Nm_s;        /* inertia and friction of the shaft with the load */
  sixstep_real current_d1, current_d0; /* V per A */
  sixstep_real speed_d1, speed_d0;     /* fraction of the full torque per rad/s */
  sixstep_real full_torque_Nm, full_current_A;
  sixstep_real current_limit_A;
  sixstep_real position_gain_rad_s_per_deg, speed_limit_rad_s; /* limit of the position loop's speed reference */
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
  const char* name;   /* short name for tables */
  const char* sentence; /* property of this controller, beginning with a verb: "counts in mA" */
  uint32_t config_bytes, state_bytes; /* up to 65536 each */
  uint32_t parameters;                /* number of parameters, up to 64 */
  const sixstep_parameter* parameter;
  /* Fills config, which is zero before the call, from the given data and one value per parameter. Returns a null
   * pointer, or the problem as a clause: "needs a higher voltage than the bus has". */
  const char* (*design)(const sixstep_given* given, const sixstep_real* values, void* config);
  /* Fills state, which is zero before the call. May be null. */
  void (*start)(const void* config, void* state);
  /* Called once per control period; answer contains the last output. */
  void (*step)(const void* config, void* state, const sixstep_measured* measured, sixstep_real setpoint, sixstep_answer* answer);
  /* Called in the Hall interrupt, for a controller that outputs a pair: sets the new pair. Null: the pair changes at the
   * next step. */
  void (*hall)(const void* config, void* state, uint8_t code, sixstep_answer* answer);
} sixstep_controller;

/* The only symbol of the shared object; visible also if the object was compiled with -fvisibility=hidden. */
#ifdef __GNUC__
__attribute__((visibility("default")))
#endif
const sixstep_controller* sixstep_own_controller(void);

#ifdef __cplusplus
}
#endif

#endif
