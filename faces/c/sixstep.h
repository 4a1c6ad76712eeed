/* SPDX-License-Identifier: Apache-2.0 */
/* libsixstep: a brushless DC drive, simulated exactly, for programs in C and in every language that can call C.
 *
 *   sixstep_session* drive;
 *   if (sixstep_open_file("drive.toml", NULL, &drive) == SIXSTEP_OK)
 *     while (sixstep_advance(drive, sixstep_time(drive) + 1e-4) == SIXSTEP_OK)
 *       printf("%g s %g rad/s\n", sixstep_time(drive), sixstep_value(drive, sixstep_signal_index("speed_rad_s")));
 *   sixstep_free(drive);
 *
 * A session is one run. A program advances, reads, changes and copies it. Only the changes and their instants determine
 * the result. Steps, reads and copies change no bit of the result. docs/howto/use-the-c-library.md shows the tasks one
 * by one.
 *
 * Errors. Every function that can fail returns a sixstep_status. Unless the status is SIXSTEP_OK or SIXSTEP_OVER, the
 * function leaves its results unchanged, and sixstep_problem_at() names place, value, limit and cure. No function ends
 * the program, throws, prints, or reads a global. For a null session, a function returns SIXSTEP_MISUSE, NaN, 0 or an
 * empty text; sixstep_outcome() returns null.
 *
 * Threads. Sessions are independent. One thread at a time may use a session; several threads may use different sessions.
 *
 * Texts are UTF-8 and end in '\0'. The value of a problem repeats the input, which may be no valid UTF-8. A text that a
 * function returns belongs to the session. It is valid until the next call of the same function for the session, or
 * until sixstep_free().
 *
 * Units are SI, as in the names of signals: docs/reference/results.md lists the signals' units and frames. For a linear
 * motor, 1 m replaces 1 rad: speed_rad_s is in m/s, angle_rad in m, torque_Nm in N. */
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

/* Number of this interface. It increases when a function or a struct changes so that programs must be recompiled. A new
 * function does not change it. */
#define SIXSTEP_ABI 1
/* The library's own SIXSTEP_ABI: compare it with SIXSTEP_ABI of the header before any other call. */
SIXSTEP_API uint32_t sixstep_abi(void);
/* Version of the library, as "0.1.0". */
SIXSTEP_API const char* sixstep_version(void);

typedef enum {
  SIXSTEP_OK = 0,
  SIXSTEP_OVER = 1,     /* the run is over: its duration has passed, or a fault stopped it. sixstep_problem_at() names
                           the fault. Signals can still be read */
  SIXSTEP_REFUSED = 2,  /* an input is not valid: sixstep_problem_at() names the reason. Nothing has changed */
  SIXSTEP_MISUSE = 3,   /* this session does not support the call: sixstep_problem_at() names the reason. Nothing has
                           changed */
  SIXSTEP_NO_MEMORY = 4 /* the session is unchanged */
} sixstep_status;

typedef struct sixstep_session sixstep_session;

/* One problem. A text that does not apply is empty. */
typedef struct {
  const char* place; /* key with file, line and column, or the function's argument: "drive.toml:3:1: pwm.period_s" */
  const char* value; /* the wrong value as it was given */
  const char* limit; /* the rule that it breaks: "must be above 0" */
  const char* cure;  /* what to do: "give the PWM period in seconds" */
} sixstep_problem;

/* Number of problems of the last call that returned SIXSTEP_REFUSED or SIXSTEP_MISUSE, or SIXSTEP_OVER after a fault;
 * 0 otherwise. */
SIXSTEP_API size_t sixstep_problem_count(const sixstep_session* session);
/* Problem `number`, from 0 on. Valid until the next call for the session. SIXSTEP_MISUSE: there is no such problem. */
SIXSTEP_API sixstep_status sixstep_problem_at(const sixstep_session* session, size_t number, sixstep_problem* problem);

/* ---- Open ---------------------------------------------------------------------------------------------------- */

/* The controller of the bridge. */
typedef enum {
  SIXSTEP_CHIP_OF_SCENARIO = 0, /* the controller that the scenario names */
  SIXSTEP_CHIP_PAIR = 1,        /* the caller, at each control tick: a driven pair and a duty (sixstep_set_pair) */
  SIXSTEP_CHIP_LEGS = 2,        /* the caller, at each control tick: three legs with a duty each (sixstep_set_leg) */
  SIXSTEP_CHIP_GATES = 3        /* the caller, at any instant: the six gates (sixstep_set_gates) */
} sixstep_chip;

/* Begin with sixstep_options options = SIXSTEP_OPTIONS and set the members that differ. */
typedef struct {
  size_t bytes;                /* sizeof(sixstep_options). By it the library recognizes the struct of an older header */
  const char* const* settings; /* null, or settings such as "pwm.period_s=40us", ended by a null; they override the
                                  scenario */
  const char* folder;          /* sixstep_open_text(): folder of the files that the text names; null: the working folder */
  const char* data;            /* null, or a folder that contains motors/NAME.toml. The library's motors need no folder */
  sixstep_chip chip;
} sixstep_options;
#define SIXSTEP_OPTIONS {sizeof(sixstep_options), NULL, NULL, NULL, SIXSTEP_CHIP_OF_SCENARIO}

/* Reads and checks a scenario (docs/reference/keys/README.md) and creates its run at t = 0. `options` may be null. After
 * SIXSTEP_REFUSED, *session contains only the problems, no run; free it too. After SIXSTEP_NO_MEMORY it is null. */
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
/* Value of a signal at the present instant. NaN: the signal has no meaning in this scenario (in duty mode there is
 * no current reference), or `index` is no signal. */
SIXSTEP_API double sixstep_value(const sixstep_session* session, int index);
/* All values, in the order of the signals. `count`: room in `values`; further values are not written. */
SIXSTEP_API sixstep_status sixstep_values(const sixstep_session* session, double* values, size_t count);

/* The session as JSON: duration, control period, signals, and the keys that sixstep_change() accepts, each key with
 * unit, meaning, default and words. */
SIXSTEP_API const char* sixstep_describe(sixstep_session* session);

/* ---- Change, copy, save -------------------------------------------------------------------------------------- */

/* Changes values at the next control tick, as an [[at]] table of a scenario does. `toml` has the lines of such a
 * table without time_s: "load.torque_Nm = 0.05". *at_s, if at_s is not null, becomes the instant of the change.
 * SIXSTEP_REFUSED: see sixstep_problem_at(). */
SIXSTEP_API sixstep_status sixstep_change(sixstep_session* session, const char* toml, double* at_s);
/* An independent session in the same state. */
SIXSTEP_API sixstep_status sixstep_copy(const sixstep_session* session, sixstep_session** copy);
/* Writes the session to `bytes` if it fits into `room` bytes. Returns the number of bytes of the saved session; 0
 * if the session cannot be saved. The bytes contain the scenario, all changes and commands, and the
 * instant. sixstep_load() simulates the run again up to this instant, to the bit. */
SIXSTEP_API size_t sixstep_save(sixstep_session* session, void* bytes, size_t room);
SIXSTEP_API sixstep_status sixstep_load(const void* bytes, size_t count, sixstep_session** session);
/* The scenario as TOML with all changes so far. A run of this text has the same bits as the session, except if the
 * caller controls the bridge: the text then names the controller "caller", which only sixstep_load() finds. */
SIXSTEP_API const char* sixstep_scenario(sixstep_session* session);

/* ---- Finish -------------------------------------------------------------------------------------------------- */

/* Ends the run: at its duration if it has passed, else at the next control tick. Then sixstep_outcome() returns the
 * results. The session can be read, but no longer advanced or changed. */
SIXSTEP_API sixstep_status sixstep_finish(sixstep_session* session);
/* Results of a finished run as JSON, as `sixstep run --json` writes them; null before sixstep_finish(). */
SIXSTEP_API const char* sixstep_outcome(const sixstep_session* session);
/* Digest over every event of a finished run. Equal runs have equal digests; 0 before sixstep_finish(). */
SIXSTEP_API uint64_t sixstep_digest(const sixstep_session* session);

/* ---- The caller as the controller ---------------------------------------------------------------------------- */

/* With SIXSTEP_CHIP_PAIR and SIXSTEP_CHIP_LEGS the library simulates the timer: it samples once per period, inserts the
 * dead time bridge.dead_time_s and switches the legs. The structs are those of a controller in a scenario
 * (sixstep/control/own/own_controller.h), so one function can serve both.
 *
 *   do {
 *     if (sixstep_measure(drive, &measured, &setpoint) == SIXSTEP_OK) {
 *       my_controller(&measured, setpoint, &answer);
 *       sixstep_command(drive, &answer);
 *     }
 *   } while (sixstep_advance_to_tick(drive) == SIXSTEP_OK); */

/* The controller's measurement at the control tick of the present instant, through the scenario's sensors, and the
 * setpoint in the mode's unit. `setpoint` may be null. SIXSTEP_MISUSE: the session is not at a control
 * tick. It is at a control tick after sixstep_advance_to_tick(), and at t = 0 unless pwm.sample = "middle". */
SIXSTEP_API sixstep_status sixstep_measure(sixstep_session* session, sixstep_measured* measured, double* setpoint);
/* Sets the answer for the next control tick and all later ticks, until another answer is set. Before the first
 * answer, all gates are off. An answer that no timer can execute ends the run at that tick, as in a scenario. */
SIXSTEP_API sixstep_status sixstep_command(sixstep_session* session, const sixstep_answer* answer);

/* SIXSTEP_CHIP_GATES: sets the gates from the present instant on, as bits 0..5: upper a, lower a, upper b, lower
 * b, upper c, lower c. The caller must keep a dead time: two set bits of a leg are a shoot-through. It ends the
 * run, and the next advance returns SIXSTEP_OVER. If gates are set twice at one instant, the last setting applies.
 * Instants of changes are rounded to 1 ps. */
SIXSTEP_API sixstep_status sixstep_set_gates(sixstep_session* session, uint32_t gates);
/* Advances to the next change of a Hall line, or to to_s if no change comes before. The signal "hall" then shows the
 * new code. Delayed edges (sensors.hall_delay_s), glitches and broken lines count as changes. With SIXSTEP_CHIP_GATES the
 * instant is rounded to 1 ps. */
SIXSTEP_API sixstep_status sixstep_advance_to_hall_edge(sixstep_session* session, double to_s);
/* SIXSTEP_CHIP_GATES: advances to the next edge of a comparator for the back-EMF, or to to_s if none comes before.
 * The comparator's input is the voltage of the terminal of leg 0, 1 or 2, minus the mean of the three terminal voltages.
 * At an edge, the input rises above level_V, or falls to level_V or below. Two changes within 1/16 of a control period
 * can remain undetected. */
SIXSTEP_API sixstep_status sixstep_advance_to_crossing(sixstep_session* session, int leg, double level_V, double to_s);

/* Converter counts of the board at the present instant, with offsets, gain errors and noise
 * ([sensors]). SIXSTEP_REFUSED: the scenario has sensors.current_bandwidth_Hz, current_delay_s or
 * bus_bandwidth_Hz, which only sixstep_measure() can apply. A converter that the scenario does not have reads 0. */
typedef struct {
  uint16_t current[3];  /* phases a, b, c, if sensors.currents = "phases" */
  uint16_t terminal[3]; /* voltage of legs a, b, c against the negative rail, by the divider and converter of the bus */
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
