/* SPDX-License-Identifier: Apache-2.0 */
/* libsixstep: a brushless DC drive, simulated exactly, for programs in C and in every language that can call C.
 *
 *   sixstep_session* drive;
 *   if (sixstep_open_file("drive.toml", NULL, &drive) == SIXSTEP_OK)
 *     while (sixstep_advance(drive, sixstep_time(drive) + 1e-4) == SIXSTEP_OK)
 *       printf("%g s %g rad/s\n", sixstep_time(drive), sixstep_value(drive, sixstep_signal_index("speed_rad_s")));
 *   sixstep_free(drive);
 *
 * A session is one run. It is advanced, read, changed and copied at will. None of this changes a bit of the
 * result: two programs that make the same changes at the same instants get the same bits, whatever steps they
 * advance by. docs/howto/use-the-c-library.md shows the tasks one by one.
 *
 * Errors. Every function that can fail returns a sixstep_status and leaves its results unchanged unless that is
 * SIXSTEP_OK or SIXSTEP_OVER. sixstep_problem_at() then names place, value, limit and cure. No function ends the
 * program, throws, prints, or reads a global. A null session is answered by SIXSTEP_MISUSE, NaN, 0, an empty text or, by
 * sixstep_outcome(), null.
 *
 * Threads. Sessions are independent: each may be used by one thread at a time, different ones at the same time.
 *
 * Texts are UTF-8 and end in '\0'. The value of a problem repeats the input, which may be no UTF-8. A text that a function returns belongs to the session, and is valid until the
 * next call of that function for the session, or its sixstep_free().
 *
 * Units are SI, as in the names of signals: docs/reference/results.md lists their units and frames. Of a linear motor 1 m
 * stands for 1 rad: speed_rad_s is in m/s, angle_rad in m, torque_Nm in N. */
#ifndef SIXSTEP_H
#define SIXSTEP_H

#include <stddef.h>
#include <stdint.h>

#include "sixstep/control/own/own_controller.h"

#if defined(__GNUC__)
#define SIXSTEP_API __attribute__((visibility("default")))
#else
#define SIXSTEP_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Number of this interface. It grows when a function or a struct changes so that programs must be compiled anew;
 * new functions leave it as it is. */
#define SIXSTEP_ABI 1
/* The library's own SIXSTEP_ABI: compare it with the header's before anything else. */
SIXSTEP_API uint32_t sixstep_abi(void);
/* Version of the library, as "0.1.0". */
SIXSTEP_API const char* sixstep_version(void);

typedef enum {
  SIXSTEP_OK = 0,
  SIXSTEP_OVER = 1,     /* the run is over: its duration has passed, or a fault stopped it, which is then the problem. Reads still work */
  SIXSTEP_REFUSED = 2,  /* an input is not valid: sixstep_problem_at() says why. Nothing has changed */
  SIXSTEP_MISUSE = 3,   /* a call that this session cannot answer; sixstep_problem_at() says why. Nothing has changed */
  SIXSTEP_NO_MEMORY = 4 /* the session is unchanged */
} sixstep_status;

typedef struct sixstep_session sixstep_session;

/* One problem. A text is empty if it has nothing to state. */
typedef struct {
  const char* place; /* key with file, line and column, or the function's argument: "drive.toml:3:1: pwm.period_s" */
  const char* value; /* the wrong value as it was given */
  const char* limit; /* the rule that it breaks: "must be above 0" */
  const char* cure;  /* what to do: "give the PWM period in seconds" */
} sixstep_problem;

/* Number of problems of the last call that returned SIXSTEP_REFUSED or SIXSTEP_MISUSE, or SIXSTEP_OVER by a fault; 0 otherwise. */
SIXSTEP_API size_t sixstep_problem_count(const sixstep_session* session);
/* Problem `number`, from 0 on. Valid until the next call for the session. SIXSTEP_MISUSE: there is no such problem. */
SIXSTEP_API sixstep_status sixstep_problem_at(const sixstep_session* session, size_t number, sixstep_problem* problem);

/* ---- Open ---------------------------------------------------------------------------------------------------- */

/* What controls the bridge. */
typedef enum {
  SIXSTEP_CHIP_OF_SCENARIO = 0, /* the controller that the scenario names */
  SIXSTEP_CHIP_PAIR = 1,        /* the caller, at each control tick: a driven pair and a duty (sixstep_set_pair) */
  SIXSTEP_CHIP_LEGS = 2,        /* the caller, at each control tick: three legs with a duty each (sixstep_set_leg) */
  SIXSTEP_CHIP_GATES = 3        /* the caller, at any instant: the six gates (sixstep_set_gates) */
} sixstep_chip;

/* Begin with sixstep_options options = SIXSTEP_OPTIONS and set what differs. */
typedef struct {
  size_t bytes;                /* sizeof(sixstep_options), by which a library knows a program's older struct */
  const char* const* settings; /* null, or keys with values, "pwm.period_s=40us", ended by a null; they override
                                  the file */
  const char* folder;          /* open_text: where files that the text names are; null: the working directory */
  const char* data;            /* null, or a folder that holds motors/NAME.toml. Motors of the library need none */
  sixstep_chip chip;
} sixstep_options;
#define SIXSTEP_OPTIONS {sizeof(sixstep_options), NULL, NULL, NULL, SIXSTEP_CHIP_OF_SCENARIO}

/* Reads and checks a scenario (docs/reference/keys/README.md) and makes its run at t = 0. `options` may be null. After
 * SIXSTEP_REFUSED *session is no run, but has the problems; free it too. After SIXSTEP_NO_MEMORY it is null. */
SIXSTEP_API sixstep_status sixstep_open_file(const char* path, const sixstep_options* options, sixstep_session** session);
SIXSTEP_API sixstep_status sixstep_open_text(const char* toml, const sixstep_options* options, sixstep_session** session);
/* Frees the session; null is allowed. */
SIXSTEP_API void sixstep_free(sixstep_session* session);

/* ---- Advance and read ---------------------------------------------------------------------------------------- */

/* Advances to the instant to_s, in s from the start. If to_s is in the past, reads that instant if it lies in the
 * segment between the last two events, else the present one. SIXSTEP_OVER: the run ended at or before to_s. */
SIXSTEP_API sixstep_status sixstep_advance(sixstep_session* session, double to_s);
/* Advances to the next control tick after the present instant, before the controller acts on it. */
SIXSTEP_API sixstep_status sixstep_advance_to_tick(sixstep_session* session);
/* Instant of the first control tick after an instant, s; both from the start of the run. NaN: none. */
SIXSTEP_API double sixstep_tick_after(const sixstep_session* session, double at_s);
/* The present instant, s. */
SIXSTEP_API double sixstep_time(const sixstep_session* session);
/* Length of a control period, and the run's duration, s. */
SIXSTEP_API double sixstep_period(const sixstep_session* session);
SIXSTEP_API double sixstep_duration(const sixstep_session* session);

/* A signal. */
typedef struct {
  const char* name;    /* "i_a_A" */
  const char* unit;    /* "A" */
  const char* frame;   /* where or in which direction it is measured; empty: no frame */
  const char* meaning; /* "current of phase a into the motor" */
} sixstep_signal;

/* Number of signals, and signal `index`; the same for all sessions. SIXSTEP_MISUSE: there is no such signal. */
SIXSTEP_API int sixstep_signal_count(void);
SIXSTEP_API sixstep_status sixstep_signal_at(int index, sixstep_signal* signal);
/* Index of a signal by its name; -1: there is none. */
SIXSTEP_API int sixstep_signal_index(const char* name);
/* Value of a signal at the present instant. NaN: the signal has no meaning in this scenario (a duty has no current
 * reference), or `index` is no signal. */
SIXSTEP_API double sixstep_value(const sixstep_session* session, int index);
/* All values, in the order of the signals. `count`: room in `values`; further values are left out. */
SIXSTEP_API sixstep_status sixstep_values(const sixstep_session* session, double* values, size_t count);

/* The session as JSON: duration, control period, its signals, and the keys that sixstep_change() takes, with unit,
 * meaning, default and words. */
SIXSTEP_API const char* sixstep_describe(sixstep_session* session);

/* ---- Change, copy, save -------------------------------------------------------------------------------------- */

/* Changes values at the next control tick, as an [[at]] table of a scenario does. `toml` has the lines of such a
 * table without time_s: "load.torque_Nm = 0.05". *at_s, if at_s is not null, becomes the instant of the change.
 * SIXSTEP_REFUSED: see sixstep_problem_at(). */
SIXSTEP_API sixstep_status sixstep_change(sixstep_session* session, const char* toml, double* at_s);
/* An independent session in the same state. */
SIXSTEP_API sixstep_status sixstep_copy(const sixstep_session* session, sixstep_session** copy);
/* Writes the session to `bytes` if it fits into `room` bytes. Returns the number of bytes of the saved session; 0
 * if the session cannot be saved. The bytes hold the scenario, all that was changed and set, and the instant:
 * sixstep_load() simulates the run again up to this instant, to the bit, also on another machine. */
SIXSTEP_API size_t sixstep_save(sixstep_session* session, void* bytes, size_t room);
SIXSTEP_API sixstep_status sixstep_load(const void* bytes, size_t count, sixstep_session** session);
/* The scenario as TOML with all changes so far; its run has the bits of this session, except where the
 * caller controls the bridge: only sixstep_load() finds the controller "caller" that the text names. */
SIXSTEP_API const char* sixstep_scenario(sixstep_session* session);

/* ---- Finish -------------------------------------------------------------------------------------------------- */

/* Ends the run: at its end if that is reached, else at the next control tick. Then sixstep_outcome() has its results;
 * the session can be read, but no longer advanced or changed. */
SIXSTEP_API sixstep_status sixstep_finish(sixstep_session* session);
/* Results of a finished run as JSON, as `sixstep run --json` writes them; null before sixstep_finish(). */
SIXSTEP_API const char* sixstep_outcome(const sixstep_session* session);
/* Digest over every event of a finished run. Equal runs have equal digests; 0 before sixstep_finish(). */
SIXSTEP_API uint64_t sixstep_digest(const sixstep_session* session);

/* ---- The caller as the controller ---------------------------------------------------------------------------- */

/* With SIXSTEP_CHIP_PAIR and SIXSTEP_CHIP_LEGS the timer is the library's: it samples once per period, makes the
 * dead time of bridge.dead_time_s and switches the legs. The structs are those of a controller in a scenario
 * (sixstep/control/own/own_controller.h), so one function can be both.
 *
 *   do {
 *     if (sixstep_measure(drive, &measured, &setpoint) == SIXSTEP_OK) {
 *       my_controller(&measured, setpoint, &answer);
 *       sixstep_command(drive, &answer);
 *     }
 *   } while (sixstep_advance_to_tick(drive) == SIXSTEP_OK); */

/* Measurement that the controller gets at the control tick of the present instant, through the scenario's sensors,
 * and the setpoint in the mode's unit. `setpoint` may be null. SIXSTEP_MISUSE: the session is not at a control
 * tick. It is at one after sixstep_advance_to_tick(), and at t = 0 unless pwm.sample = "middle". */
SIXSTEP_API sixstep_status sixstep_measure(sixstep_session* session, sixstep_measured* measured, double* setpoint);
/* Sets the answer at the next control tick and all later ticks, until another answer is set. Before the first
 * answer, all gates are off. An answer that no timer can execute ends the run at that tick, as in a scenario. */
SIXSTEP_API sixstep_status sixstep_command(sixstep_session* session, const sixstep_answer* answer);

/* SIXSTEP_CHIP_GATES: sets the gates from the present instant on, as bits 0..5: upper a, lower a, upper b, lower
 * b, upper c, lower c. The caller must keep a dead time: both bits of a leg are a shoot-through, which ends the
 * run, and the next advance returns SIXSTEP_OVER. If gates are set twice at one instant, the last ones apply.
 * Instants of changes are rounded to 1 ps. */
SIXSTEP_API sixstep_status sixstep_set_gates(sixstep_session* session, uint32_t gates);
/* Advances to the next change of a Hall line, or to to_s if none comes before; the signal "hall" shows which. Changes by
 * sensors.hall_delay_s, by a glitch or by a broken line count. With SIXSTEP_CHIP_GATES the instant is rounded to 1 ps. */
SIXSTEP_API sixstep_status sixstep_advance_to_hall_edge(sixstep_session* session, double to_s);
/* SIXSTEP_CHIP_GATES: advances to the next edge of a comparator for the back-EMF, or to to_s if none comes before.
 * At an edge, the terminal of leg 0, 1 or 2, less the mean of the three terminals, changes from above level_V to
 * at most level_V or back. Two changes within 1/16 of a control period can remain undetected. */
SIXSTEP_API sixstep_status sixstep_advance_to_crossing(sixstep_session* session, int leg, double level_V, double to_s);

/* Counts that the board's converters have at the present instant, with their offsets, gain errors and noise
 * ([sensors]). SIXSTEP_REFUSED: the scenario has sensors.current_bandwidth_Hz, current_delay_s or
 * bus_bandwidth_Hz, which only sixstep_measure() can apply. A converter that the scenario does not have reads 0. */
typedef struct {
  uint16_t current[3];  /* phases a, b, c; sensors.currents = "phases" */
  uint16_t terminal[3]; /* legs a, b, c, against the negative rail, with the bus's divider and converter */
  uint16_t bus;
  uint16_t timer;  /* lower 16 bits of the counter that captures edges, sensors.capture_Hz */
  uint8_t hall;    /* H1 H2 H3 as bits 2, 1, 0 */
} sixstep_counts;
/* Each call draws new noise. */
SIXSTEP_API sixstep_status sixstep_convert(sixstep_session* session, sixstep_counts* counts);

#ifdef __cplusplus
}
#endif

#endif
