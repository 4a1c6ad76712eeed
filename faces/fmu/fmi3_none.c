/* SPDX-License-Identifier: Apache-2.0 */
/* Functions of FMI 3.0 that a unit must export but does not support: types that no variable has, other interfaces,
 * intervals of clocks, derivatives. modelDescription.xml declares none of them. Each function returns fmi3Error with
 * a message. */
#include "faces/fmu/fmi3_instance.h"

/* For a type without variables, or without variables that can be set. An empty list of references is no error. */
static fmi3Status none(fmi3Instance c, const char* function, unsigned phases, size_t count) {
  if (!fmi3_may(c, function, phases)) return fmi3Error;
  return count == 0 ? fmi3OK : fmi3_fail(c, function, "the unit has no such variable");
}

#define NO_GETTER(type)                                                                                             \
  FMI3_FUNCTION(Get##type, (fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3##type v[], size_t room)) { \
    (void)r, (void)v, (void)room;                                                                                   \
    return none(c, "fmi3Get" #type, READABLE, n);                                                                   \
  }
#define NO_SETTER(type)                                                                                  \
  FMI3_FUNCTION(Set##type,                                                                               \
                (fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3##type v[], size_t room)) { \
    (void)r, (void)v, (void)room;                                                                        \
    return none(c, "fmi3Set" #type, SETTABLE, n);                                                        \
  }
#define NEITHER(type) NO_GETTER(type) NO_SETTER(type)
NEITHER(Float32)
NEITHER(Int8)
NEITHER(UInt8)
NEITHER(Int16)
NEITHER(UInt16)
NEITHER(UInt32)
NEITHER(Int64)
NEITHER(UInt64)
NO_SETTER(String)

FMI3_FUNCTION(GetBinary, (fmi3Instance c, const fmi3ValueReference r[], size_t n, size_t sizes[], fmi3Binary v[], size_t room)) {
  (void)r, (void)sizes, (void)v, (void)room;
  return none(c, "fmi3GetBinary", READABLE, n);
}
FMI3_FUNCTION(SetBinary, (fmi3Instance c, const fmi3ValueReference r[], size_t n, const size_t sizes[], const fmi3Binary v[],
                          size_t room)) {
  (void)r, (void)sizes, (void)v, (void)room;
  return none(c, "fmi3SetBinary", SETTABLE, n);
}
FMI3_FUNCTION(SetClock, (fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3Clock v[])) {
  (void)r, (void)v;
  return none(c, "fmi3SetClock", SETTABLE, n);
}

/* Defines a function that refuses every call. Its arguments are not used. */
#define REFUSED(name, arguments, used, why)                   \
  FMI3_FUNCTION(name, arguments) {                            \
    used;                                                     \
    return fmi3_fail(c, "fmi3" #name, why);                   \
  }
#define NO_CLOCKS "the clocks are triggered: they have no interval"
#define NO_DERIVATIVES "the unit computes no derivatives"
#define NO_EXCHANGE "the unit is for co-simulation only"

typedef const fmi3ValueReference* references;
REFUSED(GetIntervalDecimal, (fmi3Instance c, references r, size_t n, fmi3Float64 v[], fmi3IntervalQualifier q[]),
        ((void)r, (void)n, (void)v, (void)q), NO_CLOCKS)
REFUSED(GetIntervalFraction,
        (fmi3Instance c, references r, size_t n, fmi3UInt64 v[], fmi3UInt64 of[], fmi3IntervalQualifier q[]),
        ((void)r, (void)n, (void)v, (void)of, (void)q), NO_CLOCKS)
REFUSED(GetShiftDecimal, (fmi3Instance c, references r, size_t n, fmi3Float64 v[]), ((void)r, (void)n, (void)v), NO_CLOCKS)
REFUSED(GetShiftFraction, (fmi3Instance c, references r, size_t n, fmi3UInt64 v[], fmi3UInt64 of[]),
        ((void)r, (void)n, (void)v, (void)of), NO_CLOCKS)
REFUSED(SetIntervalDecimal, (fmi3Instance c, references r, size_t n, const fmi3Float64 v[]), ((void)r, (void)n, (void)v),
        NO_CLOCKS)
REFUSED(SetIntervalFraction, (fmi3Instance c, references r, size_t n, const fmi3UInt64 v[], const fmi3UInt64 of[]),
        ((void)r, (void)n, (void)v, (void)of), NO_CLOCKS)
REFUSED(SetShiftDecimal, (fmi3Instance c, references r, size_t n, const fmi3Float64 v[]), ((void)r, (void)n, (void)v),
        NO_CLOCKS)
REFUSED(SetShiftFraction, (fmi3Instance c, references r, size_t n, const fmi3UInt64 v[], const fmi3UInt64 of[]),
        ((void)r, (void)n, (void)v, (void)of), NO_CLOCKS)

REFUSED(EvaluateDiscreteStates, (fmi3Instance c), (void)0, "call fmi3UpdateDiscreteStates instead")
REFUSED(EnterConfigurationMode, (fmi3Instance c), (void)0, "the unit has no structural parameters")
REFUSED(ExitConfigurationMode, (fmi3Instance c), (void)0, "the unit has no structural parameters")

REFUSED(GetDirectionalDerivative,
        (fmi3Instance c, references u, size_t us, references k, size_t ks, const fmi3Float64 seed[], size_t seeds,
         fmi3Float64 out[], size_t outs),
        ((void)u, (void)us, (void)k, (void)ks, (void)seed, (void)seeds, (void)out, (void)outs), NO_DERIVATIVES)
REFUSED(GetAdjointDerivative,
        (fmi3Instance c, references u, size_t us, references k, size_t ks, const fmi3Float64 seed[], size_t seeds,
         fmi3Float64 out[], size_t outs),
        ((void)u, (void)us, (void)k, (void)ks, (void)seed, (void)seeds, (void)out, (void)outs), NO_DERIVATIVES)
REFUSED(GetOutputDerivatives,
        (fmi3Instance c, references r, size_t n, const fmi3Int32 orders[], fmi3Float64 v[], size_t room),
        ((void)r, (void)n, (void)orders, (void)v, (void)room), NO_DERIVATIVES)
REFUSED(GetNumberOfVariableDependencies, (fmi3Instance c, fmi3ValueReference r, size_t* n), ((void)r, (void)n),
        "the dependencies are in modelDescription.xml")
REFUSED(GetVariableDependencies,
        (fmi3Instance c, fmi3ValueReference r, size_t of[], fmi3ValueReference on[], size_t at[], fmi3DependencyKind kinds[],
         size_t n),
        ((void)r, (void)of, (void)on, (void)at, (void)kinds, (void)n), "the dependencies are in modelDescription.xml")

REFUSED(EnterContinuousTimeMode, (fmi3Instance c), (void)0, NO_EXCHANGE)
REFUSED(CompletedIntegratorStep, (fmi3Instance c, fmi3Boolean no, fmi3Boolean* event, fmi3Boolean* end),
        ((void)no, (void)event, (void)end), NO_EXCHANGE)
REFUSED(SetTime, (fmi3Instance c, fmi3Float64 time), ((void)time), NO_EXCHANGE)
REFUSED(SetContinuousStates, (fmi3Instance c, const fmi3Float64 x[], size_t n), ((void)x, (void)n), NO_EXCHANGE)
REFUSED(GetContinuousStates, (fmi3Instance c, fmi3Float64 x[], size_t n), ((void)x, (void)n), NO_EXCHANGE)
REFUSED(GetContinuousStateDerivatives, (fmi3Instance c, fmi3Float64 x[], size_t n), ((void)x, (void)n), NO_EXCHANGE)
REFUSED(GetNominalsOfContinuousStates, (fmi3Instance c, fmi3Float64 x[], size_t n), ((void)x, (void)n), NO_EXCHANGE)
REFUSED(GetEventIndicators, (fmi3Instance c, fmi3Float64 x[], size_t n), ((void)x, (void)n), NO_EXCHANGE)
REFUSED(GetNumberOfEventIndicators, (fmi3Instance c, size_t* n), ((void)n), NO_EXCHANGE)
REFUSED(GetNumberOfContinuousStates, (fmi3Instance c, size_t* n), ((void)n), NO_EXCHANGE)
REFUSED(ActivateModelPartition, (fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time), ((void)clock, (void)time),
        NO_EXCHANGE)

FMI3_EXPORT fmi3Instance FMI3(InstantiateModelExchange)(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                                        fmi3InstanceEnvironment, fmi3LogMessageCallback);
fmi3Instance FMI3(InstantiateModelExchange)(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                            fmi3Boolean loggingOn, fmi3InstanceEnvironment environment,
                                            fmi3LogMessageCallback log) {
  (void)name, (void)token, (void)resources, (void)visible, (void)loggingOn;
  if (log) log(environment, fmi3Error, "logStatusError", "fmi3InstantiateModelExchange: " NO_EXCHANGE);
  return NULL;
}
FMI3_EXPORT fmi3Instance FMI3(InstantiateScheduledExecution)(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                                             fmi3InstanceEnvironment, fmi3LogMessageCallback,
                                                             fmi3ClockUpdateCallback, fmi3LockPreemptionCallback,
                                                             fmi3LockPreemptionCallback);
fmi3Instance FMI3(InstantiateScheduledExecution)(fmi3String name, fmi3String token, fmi3String resources,
                                                 fmi3Boolean visible, fmi3Boolean loggingOn,
                                                 fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                                 fmi3ClockUpdateCallback clock, fmi3LockPreemptionCallback lock,
                                                 fmi3LockPreemptionCallback unlock) {
  (void)name, (void)token, (void)resources, (void)visible, (void)loggingOn, (void)clock, (void)lock, (void)unlock;
  if (log) log(environment, fmi3Error, "logStatusError", "fmi3InstantiateScheduledExecution: " NO_EXCHANGE);
  return NULL;
}
