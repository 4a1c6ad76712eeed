/* SPDX-License-Identifier: Apache-2.0 */
/* Types of FMI 3.0, as the standard names them. */
#ifndef SIXSTEP_FMI3_TYPES_H
#define SIXSTEP_FMI3_TYPES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef void* fmi3Instance;
typedef void* fmi3InstanceEnvironment;
typedef void* fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef float fmi3Float32;
typedef double fmi3Float64;
typedef int8_t fmi3Int8;
typedef uint8_t fmi3UInt8;
typedef int16_t fmi3Int16;
typedef uint16_t fmi3UInt16;
typedef int32_t fmi3Int32;
typedef uint32_t fmi3UInt32;
typedef int64_t fmi3Int64;
typedef uint64_t fmi3UInt64;
typedef bool fmi3Boolean;
typedef char fmi3Char;
typedef const fmi3Char* fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte* fmi3Binary;
typedef bool fmi3Clock;

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum { fmi3Independent, fmi3Constant, fmi3Fixed, fmi3Tunable, fmi3Discrete, fmi3Dependent } fmi3DependencyKind;
typedef enum { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged } fmi3IntervalQualifier;

typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String category, fmi3String message);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment, fmi3Float64 time, fmi3Boolean setRequested,
                                               fmi3Boolean getAllowed, fmi3Boolean stepFinished, fmi3Boolean canReturn,
                                               fmi3Boolean* earlyReturn, fmi3Float64* earlyReturnTime);
typedef void (*fmi3LockPreemptionCallback)(void);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment);

#if defined(__GNUC__)
#define FMI3_EXPORT __attribute__((visibility("default")))
#else
#define FMI3_EXPORT
#endif

/* A program that links several units defines FMI3_FUNCTION_PREFIX as NAME_; the functions of a shared library have
   no prefix. */
#if defined(FMI3_FUNCTION_PREFIX)
#define FMI3_JOIN(a, b) a##b
#define FMI3_PREFIXED(a, b) FMI3_JOIN(a, b)
#define FMI3(name) FMI3_PREFIXED(FMI3_FUNCTION_PREFIX, fmi3##name)
#else
#define FMI3(name) fmi3##name
#endif

/* Head of a function, declared and then defined. */
#define FMI3_FUNCTION(name, arguments)             \
  FMI3_EXPORT fmi3Status FMI3(name) arguments; /* NOLINT(bugprone-macro-parentheses): a parameter list */ \
  fmi3Status FMI3(name) arguments

#endif
