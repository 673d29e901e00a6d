#include "export/c_texts.hpp"

namespace flexspline::data {

const std::string_view kCHeader = R"(#ifndef @NAME@_H
#define @NAME@_H

/* @name@: a harmonic drive as a state-space model, written by flexspline. SI units: rad, rad/s, Nm, s;
 * motor quantities at the motor shaft, others at the output. No allocation, no global state.
@head@ */

#ifdef __cplusplus
extern "C" {
#endif

#define @NAME@_STATES @states@ /* @state_names@ */

typedef struct {
@input@} @name@_input;

typedef struct {
  double motor_angle;
  double motor_speed;
  double load_angle;
  double load_speed;
  double torsion;            /* motor_angle/N - load_angle */
  double transmitted_torque; /* at the output, across the flexspline */
} @name@_output;

typedef struct {
  double time;
  double y[@size@];
} @name@_state;

/* At rest, unloaded, every memory empty, time 0. */
void @name@_reset(@name@_state *state);

/* dy/dt, @NAME@_STATES numbers, and the outputs (may be null) at an instant under an input that rises
 * at the rate torque_rate. */
void @name@_rates(double time, const double *y, const @name@_input *u, double torque_rate, double *dy,
                  @name@_output *out);

/* Advances the state by dt > 0 under an input that goes in a straight line from one value to the
 * other; give the same twice for one that is held. Radau IIA of order 5, implicit: stable for stiff
 * friction at any dt. Returns 0, or 1 where the equations could not be solved; the state then stays. */
int @name@_step(@name@_state *state, const @name@_input *from, const @name@_input *to, double dt);

/* The outputs in a state. */
void @name@_outputs(const @name@_state *state, const @name@_input *u, @name@_output *out);
@feed_forward_declaration@
#ifdef __cplusplus
}
#endif

#endif
)";

const std::string_view kCStep = R"(
#define ROWS (3 * SIZE)

static void solve(double m[ROWS][ROWS], double *b) {
  int i, k, j;
  for (k = 0; k < ROWS; ++k) {
    int pivot = k;
    double swap;
    for (i = k + 1; i < ROWS; ++i) {
      if (fabs(m[i][k]) > fabs(m[pivot][k])) pivot = i;
    }
    for (j = k; pivot != k && j < ROWS; ++j) {
      swap = m[k][j];
      m[k][j] = m[pivot][j];
      m[pivot][j] = swap;
    }
    swap = b[k];
    b[k] = b[pivot];
    b[pivot] = swap;
    for (i = k + 1; i < ROWS; ++i) {
      const double factor = m[i][k] / m[k][k];
      if (factor == 0.0) continue;
      for (j = k; j < ROWS; ++j) m[i][j] -= factor * m[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (i = ROWS - 1; i >= 0; --i) {
    for (j = i + 1; j < ROWS; ++j) b[i] -= m[i][j] * b[j];
    b[i] /= m[i][i];
  }
}

typedef struct {
  const @name@_input *from, *to;
  double start, length;
} ramp;

static void rates_on(const ramp *r, double t, const double *y, double *dy) {
  const double share = (t - r->start) / r->length;
  const @name@_input u = between(r->from, r->to, share);
  @name@_rates(t, y, &u, rise(r->from, r->to) / r->length, dy, 0);
}

/* Newton's iteration on all three stages, with the Jacobian of the first instant. */
static int radau(const ramp *r, double t, double h, double *y) {
  static const double c[3] = {0.15505102572168219, 0.64494897427831781, 1.0};
  static const double a[3][3] = {
      {0.19681547722366044, -0.065535425850198386, 0.023770974348220154},
      {0.39442431473908727, 0.29207341166522844, -0.041548752125997930},
      {0.37640306270046727, 0.51248582618842161, 0.11111111111111111}};
  double jacobian[SIZE][SIZE], f[3][SIZE], z[3][SIZE], at[SIZE], b[ROWS];
  double before = HUGE_VAL;
  int i, j, k, l, round;
  rates_on(r, t, y, f[0]);
  for (k = 0; k < SIZE; ++k) {
    const double eps = 1e-7 * (fabs(y[k]) + 1e-3);
    memcpy(at, y, sizeof at);
    at[k] += eps;
    rates_on(r, t, at, f[1]);
    for (i = 0; i < SIZE; ++i) jacobian[i][k] = (f[1][i] - f[0][i]) / eps;
  }
  memset(z, 0, sizeof z);
  for (round = 0; round < 50; ++round) {
    double m[ROWS][ROWS], size = 0.0;
    for (i = 0; i < 3; ++i) {
      for (k = 0; k < SIZE; ++k) at[k] = y[k] + z[i][k];
      rates_on(r, t + c[i] * h, at, f[i]);
    }
    for (i = 0; i < 3; ++i) {
      for (k = 0; k < SIZE; ++k) {
        b[i * SIZE + k] = -z[i][k];
        for (j = 0; j < 3; ++j) {
          b[i * SIZE + k] += h * a[i][j] * f[j][k];
          for (l = 0; l < SIZE; ++l) {
            m[i * SIZE + k][j * SIZE + l] =
                (i == j && k == l ? 1.0 : 0.0) - h * a[i][j] * jacobian[k][l];
          }
        }
      }
    }
    solve(m, b);
    for (i = 0; i < 3; ++i) {
      for (k = 0; k < SIZE; ++k) {
        const double moved = fabs(b[i * SIZE + k]) / (fabs(y[k]) + fabs(z[i][k]) + 1e-6);
        z[i][k] += b[i * SIZE + k];
        if (!(moved <= size)) size = moved;
      }
    }
    if (size < 1e-14 || (size < 1e-10 && size >= before)) {
      for (k = 0; k < SIZE; ++k) y[k] += z[2][k];
      return 0;
    }
    if (!(size < 1e10)) return 1;
    before = size;
  }
  return 1;
}

/* Halves a step whose equations could not be solved. */
static int advance(const ramp *r, double t, double h, double *y, int halvings) {
  double tried[SIZE];
  memcpy(tried, y, sizeof tried);
  if (radau(r, t, h, tried) == 0) {
    memcpy(y, tried, sizeof tried);
    return 0;
  }
  if (halvings == 0) return 1;
  return advance(r, t, 0.5 * h, y, halvings - 1) != 0
             ? 1
             : advance(r, t + 0.5 * h, 0.5 * h, y, halvings - 1);
}

int @name@_step(@name@_state *state, const @name@_input *from, const @name@_input *to, double dt) {
  const ramp r = {from, to, state->time, dt};
  double y[SIZE];
  memcpy(y, state->y, sizeof y);
  if (advance(&r, state->time, dt, y, 14) != 0) return 1;
  memcpy(state->y, y, sizeof y);
  state->time += dt;
  return 0;
}
)";

}  // namespace flexspline::data
