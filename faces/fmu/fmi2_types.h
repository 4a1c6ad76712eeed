/* SPDX-License-Identifier: Apache-2.0 */
/* Types and functions of FMI 2.0 for co-simulation, as the standard names them. */
#ifndef SIXSTEP_FMI2_TYPES_H
#define SIXSTEP_FMI2_TYPES_H

#include <stddef.h>

typedef void* fmi2Component;
typedef void* fmi2ComponentEnvironment;
typedef void* fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef const fmi2Char* fmi2String;
typedef char fmi2Byte;

#define fmi2True 1
#define fmi2False 0

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef struct {
  void (*logger)(fmi2ComponentEnvironment, fmi2String instanceName, fmi2Status, fmi2String category, fmi2String message,
                 ...);
  void* (*allocateMemory)(size_t, size_t);
  void (*freeMemory)(void*);
  void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

/* A program that links several units defines FMI2_FUNCTION_PREFIX as NAME_; the functions of a shared library have
   no prefix. */
#if defined(FMI2_FUNCTION_PREFIX)
#define FMI2_JOIN(a, b) a##b
#define FMI2_PREFIXED(a, b) FMI2_JOIN(a, b)
#define FMI2(name) FMI2_PREFIXED(FMI2_FUNCTION_PREFIX, fmi2##name)
#else
#define FMI2(name) fmi2##name
#endif
#if defined(__GNUC__)
#define FMI2_API __attribute__((visibility("default")))
#else
#define FMI2_API
#endif

FMI2_API const char* FMI2(GetTypesPlatform)(void);
FMI2_API const char* FMI2(GetVersion)(void);
FMI2_API fmi2Status FMI2(SetDebugLogging)(fmi2Component, fmi2Boolean, size_t, const fmi2String[]);
FMI2_API fmi2Component FMI2(Instantiate)(fmi2String name, fmi2Type, fmi2String guid, fmi2String resources,
                                         const fmi2CallbackFunctions*, fmi2Boolean visible, fmi2Boolean loggingOn);
FMI2_API void FMI2(FreeInstance)(fmi2Component);
FMI2_API fmi2Status FMI2(SetupExperiment)(fmi2Component, fmi2Boolean hasTolerance, fmi2Real tolerance, fmi2Real start,
                                          fmi2Boolean hasStop, fmi2Real stop);
FMI2_API fmi2Status FMI2(EnterInitializationMode)(fmi2Component);
FMI2_API fmi2Status FMI2(ExitInitializationMode)(fmi2Component);
FMI2_API fmi2Status FMI2(Terminate)(fmi2Component);
FMI2_API fmi2Status FMI2(Reset)(fmi2Component);
FMI2_API fmi2Status FMI2(GetReal)(fmi2Component, const fmi2ValueReference[], size_t, fmi2Real[]);
FMI2_API fmi2Status FMI2(GetInteger)(fmi2Component, const fmi2ValueReference[], size_t, fmi2Integer[]);
FMI2_API fmi2Status FMI2(GetBoolean)(fmi2Component, const fmi2ValueReference[], size_t, fmi2Boolean[]);
FMI2_API fmi2Status FMI2(GetString)(fmi2Component, const fmi2ValueReference[], size_t, fmi2String[]);
FMI2_API fmi2Status FMI2(SetReal)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Real[]);
FMI2_API fmi2Status FMI2(SetInteger)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[]);
FMI2_API fmi2Status FMI2(SetBoolean)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Boolean[]);
FMI2_API fmi2Status FMI2(SetString)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2String[]);
FMI2_API fmi2Status FMI2(GetFMUstate)(fmi2Component, fmi2FMUstate*);
FMI2_API fmi2Status FMI2(SetFMUstate)(fmi2Component, fmi2FMUstate);
FMI2_API fmi2Status FMI2(FreeFMUstate)(fmi2Component, fmi2FMUstate*);
FMI2_API fmi2Status FMI2(SerializedFMUstateSize)(fmi2Component, fmi2FMUstate, size_t*);
FMI2_API fmi2Status FMI2(SerializeFMUstate)(fmi2Component, fmi2FMUstate, fmi2Byte[], size_t);
FMI2_API fmi2Status FMI2(DeSerializeFMUstate)(fmi2Component, const fmi2Byte[], size_t, fmi2FMUstate*);
FMI2_API fmi2Status FMI2(GetDirectionalDerivative)(fmi2Component, const fmi2ValueReference unknown[], size_t,
                                                   const fmi2ValueReference known[], size_t, const fmi2Real[], fmi2Real[]);
FMI2_API fmi2Status FMI2(SetRealInputDerivatives)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[],
                                                  const fmi2Real[]);
FMI2_API fmi2Status FMI2(GetRealOutputDerivatives)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[],
                                                   fmi2Real[]);
FMI2_API fmi2Status FMI2(DoStep)(fmi2Component, fmi2Real point, fmi2Real size, fmi2Boolean noStateBefore);
FMI2_API fmi2Status FMI2(CancelStep)(fmi2Component);
FMI2_API fmi2Status FMI2(GetStatus)(fmi2Component, fmi2StatusKind, fmi2Status*);
FMI2_API fmi2Status FMI2(GetRealStatus)(fmi2Component, fmi2StatusKind, fmi2Real*);
FMI2_API fmi2Status FMI2(GetIntegerStatus)(fmi2Component, fmi2StatusKind, fmi2Integer*);
FMI2_API fmi2Status FMI2(GetBooleanStatus)(fmi2Component, fmi2StatusKind, fmi2Boolean*);
FMI2_API fmi2Status FMI2(GetStringStatus)(fmi2Component, fmi2StatusKind, fmi2String*);

#endif
