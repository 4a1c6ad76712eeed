/* SPDX-License-Identifier: Apache-2.0 */
/* A user's controller that makes an error at a certain place. MISBEHAVES names the error; `well` makes none. The
 * error occurs in step 20, or in step MISBEHAVES_AT. */
#define _GNU_SOURCE
#include <fenv.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#include "sixstep/control/own/own_controller.h"

typedef struct {
  int32_t steps;
  double x;
} State;

typedef struct {
  double gain, bus;
} Config;

static int is(const char* deed) {
  const char* const asked = getenv("MISBEHAVES");
  return asked != NULL && strcmp(asked, deed) == 0;
}

static int number_of(const char* variable, int otherwise) {
  const char* const text = getenv(variable);
  return text != NULL ? atoi(text) : otherwise;
}

static volatile int zero = 0;
static char deep(volatile char* above) {
  volatile char here[4096];
  here[0] = *above;
  return (char)(deep(here) + here[zero]);
}

static void* end_all(void* unused) {
  (void)unused;
  exit(0);
}

static void crash(const char* where) {
  char word[40];
#define DEED(name, what)                              \
  snprintf(word, sizeof word, "%s-%s", where, name); \
  if (is(word)) what
  DEED("exit", exit(0));
  DEED("quick_exit", quick_exit(0));
  DEED("_exit", _exit(0));
  DEED("_Exit", _Exit(0));
  DEED("abort", abort());
  DEED("null", *(volatile int*)(intptr_t)zero = 1);
  DEED("divide", zero = 100 / zero);
  DEED("illegal", __builtin_trap());
  DEED("recursion", zero = deep((volatile char*)word));
  DEED("pthread_exit", pthread_exit(NULL));
  DEED("loop", for (;;) zero = 0);
#undef DEED
}

static const char* design(const sixstep_given* given, const sixstep_real* values, void* config) {
  Config* const own = config;
  (void)values;
  crash("design");
  own->gain = 0.05;
  own->bus = given->bus_V;
  if (is("behind-config")) memset((char*)config + sizeof(Config), 255, (size_t)number_of("MISBEHAVES_BY", 1));
  if (is("before-config")) ((char*)config)[-1] = 1;
  if (is("bad-sentence")) return (const char*)1;
  if (is("long-sentence")) {
    static char words[100000];
    memset(words, 'a', sizeof words - 1);
    return words;
  }
  return NULL;
}

static void start(const void* config, void* state) {
  (void)config, (void)state;
  crash("start");
}

static void step(const void* config, void* state, const sixstep_measured* measured, sixstep_real setpoint,
                 sixstep_answer* answer) {
  const Config* const own = config;
  State* const mine = state;
  const double wanted = own->gain * (setpoint - measured->current_A[0]);
  mine->x += 1e-3 * wanted; /* the sum is rounded at each step */
  answer->enabled = 1;
  answer->source = SIXSTEP_LEG_A;
  answer->sink = SIXSTEP_LEG_B;
  answer->chopping = SIXSTEP_SOFT;
  answer->duty = 0.2 + mine->x / 3.0;
  if (answer->duty < 0) answer->duty = 0;
  if (answer->duty > 1) answer->duty = 1;
  if (++mine->steps != number_of("MISBEHAVES_AT", 20)) return;
  crash("step");
  if (is("behind-state")) memset((char*)state + sizeof(State), 255, (size_t)number_of("MISBEHAVES_BY", 1));
  if (is("before-state")) ((char*)state)[-1] = 1;
  if (is("far-before-state")) memset((char*)state - 4096, 255, 65536);
  if (is("behind-answer")) memset((char*)answer + sizeof *answer, 255, (size_t)number_of("MISBEHAVES_BY", 1));
  if (is("into-config")) ((Config*)(intptr_t)config)->gain = 2;
  if (is("stack")) {
    volatile char room[1000];
    memset((char*)room, 1, (size_t)(200000 + zero));
  }
  if (is("thread-exit")) {
    pthread_t thread;
    pthread_create(&thread, NULL, end_all, NULL);
    pthread_join(thread, NULL);
  }
  if (is("rounding")) fesetround(FE_UPWARD);
#if defined(__x86_64__)
  if (is("flush-to-zero")) _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
  if (is("exceptions")) {
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW | FE_INEXACT);
  }
  if (is("exception-at-work")) {
    volatile double nothing = 0.0;
    feenableexcept(FE_DIVBYZERO);
    mine->x = 1.0 / nothing;
  }
  if (is("not-a-number")) answer->duty = 0.0 / (double)zero;
  if (is("endless")) answer->duty = 1.0 / (double)zero;
  if (is("negative")) answer->duty = -0.1;
  if (is("no-leg")) answer->source = 7;
  if (is("one-leg")) answer->source = answer->sink;
  if (is("no-choice")) answer->chopping = 99;
  if (is("overlap")) answer->overlap = 0.0 / (double)zero;
  if (is("gives-up")) answer->fault = 1;
  if (is("other-folder") && chdir("/") != 0) abort();
  if (is("deaf")) signal(SIGINT, SIG_IGN), signal(SIGTERM, SIG_IGN);
  if (is("slow")) usleep(2000);
}

static void hall(const void* config, void* state, uint8_t code, sixstep_answer* answer) {
  (void)config, (void)state, (void)code, (void)answer;
  crash("hall");
}

const sixstep_controller* sixstep_own_controller(void) {
  static sixstep_controller own = {SIXSTEP_OWN_INTERFACE,
                                   SIXSTEP_ANSWERS_PAIR,
                                   "misbehaves",
                                   "it does what none may do",
                                   sizeof(Config),
                                   sizeof(State),
                                   0,
                                   NULL,
                                   design,
                                   start,
                                   step,
                                   hall};
  crash("load");
  if (is("bad-name")) own.name = (const char*)1;
  if (is("huge")) own.config_bytes = own.state_bytes = 4000000000u;
  if (is("no-step")) own.step = NULL;
  if (is("no-list")) own.parameters = 64;
  if (is("nothing")) return NULL;
  return &own;
}
