#include "export/fmi3_text.hpp"

namespace flexspline::data {

const std::string_view kFmi3Source =
    R"(/* FMI 3.0 for co-simulation of @name@.c. Types as the standard defines them, section 2.2. What a
 * co-simulation of real variables without events has no use for returns fmi3Error. */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "@name@.h"

#if defined(_WIN32)
#define FMI __declspec(dllexport)
#else
#define FMI __attribute__((visibility("default")))
#endif

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef void *fmi3Instance;
typedef void *fmi3InstanceEnvironment;
typedef void *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef bool fmi3Boolean;
typedef double fmi3Float64;
typedef const char *fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte *fmi3Binary;
typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String, fmi3String);

enum { TIME, FIRST_INPUT, FIRST_OUTPUT = 3, END = 9 };

typedef struct {
  @name@_state state;
  double input[2];
} fmu;

static @name@_input input_of(const double *values) {
  @name@_input u;
  memcpy(&u, values, sizeof u);
  return u;
}

FMI const char *fmi3GetVersion(void) { return "3.0"; }

FMI fmi3Status fmi3SetDebugLogging(fmi3Instance i, fmi3Boolean on, size_t n, const fmi3String *c) {
  (void)i;
  (void)on;
  (void)n;
  (void)c;
  return fmi3OK;
}

FMI fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3Boolean events, fmi3Boolean early_return, const fmi3ValueReference *intermediate, size_t n,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, void *update) {
  fmu *m;
  (void)name;
  (void)resources;
  (void)visible;
  (void)logging;
  (void)events;
  (void)early_return;
  (void)intermediate;
  (void)n;
  (void)update;
  if (token == NULL || strcmp(token, "@token@") != 0) {
    if (log != NULL) log(environment, fmi3Error, "error", "the instantiation token is another model's");
    return NULL;
  }
  m = (fmu *)calloc(1, sizeof *m);
  if (m != NULL) @name@_reset(&m->state);
  return m;
}

FMI fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                              fmi3Boolean visible, fmi3Boolean logging,
                                              fmi3InstanceEnvironment environment,
                                              fmi3LogMessageCallback log) {
  (void)name;
  (void)token;
  (void)resources;
  (void)visible;
  (void)logging;
  (void)environment;
  (void)log;
  return NULL;
}

FMI fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token,
                                                   fmi3String resources, fmi3Boolean visible,
                                                   fmi3Boolean logging,
                                                   fmi3InstanceEnvironment environment,
                                                   fmi3LogMessageCallback log, void *update,
                                                   void *lock, void *unlock) {
  (void)name;
  (void)token;
  (void)resources;
  (void)visible;
  (void)logging;
  (void)environment;
  (void)log;
  (void)update;
  (void)lock;
  (void)unlock;
  return NULL;
}

FMI void fmi3FreeInstance(fmi3Instance i) { free(i); }

FMI fmi3Status fmi3EnterInitializationMode(fmi3Instance i, fmi3Boolean tolerance_given, fmi3Float64 tolerance,
                                           fmi3Float64 start, fmi3Boolean stop_given, fmi3Float64 stop) {
  (void)tolerance_given;
  (void)tolerance;
  (void)stop_given;
  (void)stop;
  ((fmu *)i)->state.time = start;
  return fmi3OK;
}

FMI fmi3Status fmi3ExitInitializationMode(fmi3Instance i) {
  (void)i;
  return fmi3OK;
}

FMI fmi3Status fmi3Terminate(fmi3Instance i) {
  (void)i;
  return fmi3OK;
}

FMI fmi3Status fmi3Reset(fmi3Instance i) {
  fmu *m = (fmu *)i;
  memset(m, 0, sizeof *m);
  @name@_reset(&m->state);
  return fmi3OK;
}

FMI fmi3Status fmi3GetFloat64(fmi3Instance i, const fmi3ValueReference *r, size_t n, fmi3Float64 *values,
                              size_t count) {
  fmu *m = (fmu *)i;
  const @name@_input u = input_of(m->input);
  @name@_output out;
  double numbers[6];
  size_t k;
  if (n != count) return fmi3Error;
  @name@_outputs(&m->state, &u, &out);
  memcpy(numbers, &out, sizeof numbers);
  for (k = 0; k < n; ++k) {
    if (r[k] >= END) return fmi3Error;
    values[k] = r[k] == TIME              ? m->state.time
                : r[k] < FIRST_OUTPUT     ? m->input[r[k] - FIRST_INPUT]
                                          : numbers[r[k] - FIRST_OUTPUT];
  }
  return fmi3OK;
}

FMI fmi3Status fmi3SetFloat64(fmi3Instance i, const fmi3ValueReference *r, size_t n,
                              const fmi3Float64 *values, size_t count) {
  size_t k;
  if (n != count) return fmi3Error;
  for (k = 0; k < n; ++k) {
    if (r[k] < FIRST_INPUT || r[k] >= FIRST_OUTPUT) return fmi3Error;
    ((fmu *)i)->input[r[k] - FIRST_INPUT] = values[k];
  }
  return fmi3OK;
}

/* Inputs are held over a communication step, as the standard has it; 1 ms at most is one step of the
 * integration. */
FMI fmi3Status fmi3DoStep(fmi3Instance i, fmi3Float64 now, fmi3Float64 size, fmi3Boolean no_set_state,
                          fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early,
                          fmi3Float64 *reached) {
  fmu *m = (fmu *)i;
  const @name@_input u = input_of(m->input);
  const int steps = size > 1e-3 ? (int)(size / 1e-3 + 0.999999) : 1;
  int k;
  (void)no_set_state;
  *event = *terminate = *early = false;
  m->state.time = now;
  for (k = 0; k < steps; ++k) {
    if (@name@_step(&m->state, &u, &u, size / steps) != 0) {
      *reached = m->state.time;
      return fmi3Error;
    }
  }
  m->state.time = *reached = now + size;
  return fmi3OK;
}

FMI fmi3Status fmi3GetFMUState(fmi3Instance i, fmi3FMUState *state) {
  if (*state == NULL) *state = malloc(sizeof(fmu));
  if (*state == NULL) return fmi3Error;
  memcpy(*state, i, sizeof(fmu));
  return fmi3OK;
}

FMI fmi3Status fmi3SetFMUState(fmi3Instance i, fmi3FMUState state) {
  memcpy(i, state, sizeof(fmu));
  return fmi3OK;
}

FMI fmi3Status fmi3FreeFMUState(fmi3Instance i, fmi3FMUState *state) {
  (void)i;
  free(*state);
  *state = NULL;
  return fmi3OK;
}

FMI fmi3Status fmi3SerializedFMUStateSize(fmi3Instance i, fmi3FMUState state, size_t *size) {
  (void)i;
  (void)state;
  *size = sizeof(fmu);
  return fmi3OK;
}

FMI fmi3Status fmi3SerializeFMUState(fmi3Instance i, fmi3FMUState state, fmi3Byte *bytes, size_t size) {
  (void)i;
  if (size < sizeof(fmu)) return fmi3Error;
  memcpy(bytes, state, sizeof(fmu));
  return fmi3OK;
}

FMI fmi3Status fmi3DeserializeFMUState(fmi3Instance i, const fmi3Byte *bytes, size_t size,
                                       fmi3FMUState *state) {
  if (size != sizeof(fmu) || fmi3GetFMUState(i, state) != fmi3OK) return fmi3Error;
  memcpy(*state, bytes, sizeof(fmu));
  return fmi3OK;
}

)"
    R"(
#define NONE_OF(type, c_type)                                                                        \
  FMI fmi3Status fmi3Get##type(fmi3Instance i, const fmi3ValueReference *r, size_t n, c_type *v,     \
                               size_t c) {                                                           \
    (void)i, (void)r, (void)v, (void)c;                                                              \
    return n == 0 ? fmi3OK : fmi3Error;                                                              \
  }                                                                                                  \
  FMI fmi3Status fmi3Set##type(fmi3Instance i, const fmi3ValueReference *r, size_t n,                \
                               const c_type *v, size_t c) {                                          \
    (void)i, (void)r, (void)v, (void)c;                                                              \
    return n == 0 ? fmi3OK : fmi3Error;                                                              \
  }

NONE_OF(Float32, float)
NONE_OF(Int8, int8_t)
NONE_OF(UInt8, uint8_t)
NONE_OF(Int16, int16_t)
NONE_OF(UInt16, uint16_t)
NONE_OF(Int32, int32_t)
NONE_OF(UInt32, uint32_t)
NONE_OF(Int64, int64_t)
NONE_OF(UInt64, uint64_t)
NONE_OF(Boolean, fmi3Boolean)
NONE_OF(String, fmi3String)

#define REFUSED(name, ...)              \
  FMI fmi3Status name(__VA_ARGS__) {    \
    return fmi3Error;                   \
  }

#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif
REFUSED(fmi3GetBinary, fmi3Instance i, const fmi3ValueReference *r, size_t n, size_t *s, fmi3Binary *v, size_t c)
REFUSED(fmi3SetBinary, fmi3Instance i, const fmi3ValueReference *r, size_t n, const size_t *s, const fmi3Binary *v, size_t c)
REFUSED(fmi3GetClock, fmi3Instance i, const fmi3ValueReference *r, size_t n, fmi3Boolean *v)
REFUSED(fmi3SetClock, fmi3Instance i, const fmi3ValueReference *r, size_t n, const fmi3Boolean *v)
REFUSED(fmi3EnterEventMode, fmi3Instance i)
REFUSED(fmi3GetNumberOfVariableDependencies, fmi3Instance i, fmi3ValueReference r, size_t *n)
REFUSED(fmi3GetVariableDependencies, fmi3Instance i, fmi3ValueReference d, size_t *e, fmi3ValueReference *v, size_t *f, int *k, size_t n)
REFUSED(fmi3GetDirectionalDerivative, fmi3Instance i, const fmi3ValueReference *u, size_t nu, const fmi3ValueReference *k, size_t nk, const double *s, size_t ns, double *v, size_t nv)
REFUSED(fmi3GetAdjointDerivative, fmi3Instance i, const fmi3ValueReference *u, size_t nu, const fmi3ValueReference *k, size_t nk, const double *s, size_t ns, double *v, size_t nv)
REFUSED(fmi3EnterConfigurationMode, fmi3Instance i)
REFUSED(fmi3ExitConfigurationMode, fmi3Instance i)
REFUSED(fmi3GetIntervalDecimal, fmi3Instance i, const fmi3ValueReference *r, size_t n, double *v, int *q)
REFUSED(fmi3GetIntervalFraction, fmi3Instance i, const fmi3ValueReference *r, size_t n, uint64_t *c, uint64_t *s, int *q)
REFUSED(fmi3GetShiftDecimal, fmi3Instance i, const fmi3ValueReference *r, size_t n, double *v)
REFUSED(fmi3GetShiftFraction, fmi3Instance i, const fmi3ValueReference *r, size_t n, uint64_t *c, uint64_t *s)
REFUSED(fmi3SetIntervalDecimal, fmi3Instance i, const fmi3ValueReference *r, size_t n, const double *v)
REFUSED(fmi3SetIntervalFraction, fmi3Instance i, const fmi3ValueReference *r, size_t n, const uint64_t *c, const uint64_t *s)
REFUSED(fmi3SetShiftDecimal, fmi3Instance i, const fmi3ValueReference *r, size_t n, const double *v)
REFUSED(fmi3SetShiftFraction, fmi3Instance i, const fmi3ValueReference *r, size_t n, const uint64_t *c, const uint64_t *s)
REFUSED(fmi3EvaluateDiscreteStates, fmi3Instance i)
REFUSED(fmi3UpdateDiscreteStates, fmi3Instance i, fmi3Boolean *a, fmi3Boolean *b, fmi3Boolean *c, fmi3Boolean *d, fmi3Boolean *e, double *t)
REFUSED(fmi3EnterContinuousTimeMode, fmi3Instance i)
REFUSED(fmi3CompletedIntegratorStep, fmi3Instance i, fmi3Boolean a, fmi3Boolean *b, fmi3Boolean *c)
REFUSED(fmi3SetTime, fmi3Instance i, double t)
REFUSED(fmi3SetContinuousStates, fmi3Instance i, const double *x, size_t n)
REFUSED(fmi3GetContinuousStateDerivatives, fmi3Instance i, double *x, size_t n)
REFUSED(fmi3GetEventIndicators, fmi3Instance i, double *x, size_t n)
REFUSED(fmi3GetContinuousStates, fmi3Instance i, double *x, size_t n)
REFUSED(fmi3GetNominalsOfContinuousStates, fmi3Instance i, double *x, size_t n)
REFUSED(fmi3GetNumberOfEventIndicators, fmi3Instance i, size_t *n)
REFUSED(fmi3GetNumberOfContinuousStates, fmi3Instance i, size_t *n)
REFUSED(fmi3EnterStepMode, fmi3Instance i)
REFUSED(fmi3GetOutputDerivatives, fmi3Instance i, const fmi3ValueReference *r, size_t n, const int32_t *o, double *v, size_t c)
REFUSED(fmi3ActivateModelPartition, fmi3Instance i, fmi3ValueReference r, double t)
)";

}  // namespace flexspline::data
