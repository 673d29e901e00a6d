#include "export/c_texts.hpp"

namespace flexspline::data {
namespace {

constexpr std::string_view kMotorInput = R"(  double motor_torque; /* at the motor shaft */
  double load_torque;  /* external, opposes the output */
)";

// Desired motion of the output: f and what else the gear transmits give the torsion and so the
// motor.
constexpr std::string_view kFeedForward = R"(
static double root_of_spring(double torque) {
  double low = -1e-3, high = 1e-3;
  int k;
  for (k = 0; k < 60 && law_f(low) > torque; ++k) low *= 2.0;
  for (k = 0; k < 60 && law_f(high) < torque; ++k) high *= 2.0;
  for (k = 0; k < 200 && high - low > 1e-16 * (fabs(low) + fabs(high)); ++k) {
    const double middle = 0.5 * (low + high);
    if (law_f(middle) < torque) low = middle; else high = middle;
  }
  return 0.5 * (low + high);
}

void @name@_feed_forward(const @name@_desired *d, double *motor_angle, double *motor_torque) {
  const double z[SIZE] = {0.0};
  instant x = {0};
  double torque, slope, phi, step;
  x.gear_ratio = N;
  x.load_angle = d->angle;
  x.load_speed = d->speed;
  x.motor_angle = N * d->angle;
  x.motor_speed = N * d->speed;
  torque = J2 * d->acceleration + B2 * d->speed + WEIGHT * sin(d->angle) + at_load(&x, z) +
           d->load_torque;
  phi = root_of_spring(torque);
  step = 1e-6 * (fabs(phi) + 1e-6);
  slope = (law_f(phi + step) - law_f(phi - step)) / (2.0 * step);
  x.torsion_rate = slope > 0.0 ? J2 * d->jerk / slope : 0.0;
  /* The damper and friction across the gear carry their share; the spring carries the rest. */
  x.torsion = phi;
  phi = root_of_spring(torque - law_g_inverse(x.torsion_rate / law_h(phi)) - at_transmission(&x, z));
  x.torsion = phi;
  x.transmitted_torque = torque;
  *motor_angle = N * (d->angle + phi - kinematics(&x, z));
  x.motor_angle = *motor_angle;
  x.motor_speed = N * (d->speed + x.torsion_rate);
  *motor_torque = J1 * N * d->acceleration + C1 * tanh(x.motor_speed / W1) + B1 * x.motor_speed +
                  torque / N;
  /* Effects that follow the motor torque, as an error of its constant does: a fixed point. */
  {
    const double rest = *motor_torque;
    int k;
    for (k = 0; k < 40; ++k) {
      x.motor_torque = *motor_torque;
      *motor_torque = rest + at_motor(&x, z);
    }
  }
}
)";

constexpr std::string_view kFeedForwardSays = R"(
/* What a controller is to ask of the motor for a desired motion of the output: the angle that the
 * compliance asks for beyond N times the output's, and the torque that inertia, weight and friction
 * ask for. What remembers is taken as unloaded. */
typedef struct {
  double angle, speed, acceleration, jerk; /* of the output */
  double load_torque;                      /* external, opposes the output */
} @name@_desired;

void @name@_feed_forward(const @name@_desired *desired, double *motor_angle, double *motor_torque);
)";

constexpr std::string_view kTwoMasses = R"(
void @name@_rates(double time, const double *y, const @name@_input *u, double torque_rate, double *dy,
                  @name@_output *out) {
  const double *z = y + OWN;
  instant x = {0}, rigid, half;
  double torque, motor, load;
  x.time = time;
  x.gear_ratio = N;
  x.motor_angle = y[0];
  x.motor_speed = y[1];
  x.load_angle = LOAD_ANGLE;
  x.load_speed = LOAD_SPEED;
  x.torsion = x.motor_angle / N - x.load_angle;
  x.torsion_rate = x.motor_speed / N - x.load_speed;
  x.motor_torque = u->motor_torque;
  x.motor_torque_rate = torque_rate;
  rigid = x;
  x.torsion += kinematics(&rigid, z);
  x.torsion_rate += kinematics_rate(&rigid, z);
  x.transmitted_torque = law_f(x.torsion) + law_g_inverse(x.torsion_rate / law_h(x.torsion));
  torque = x.transmitted_torque + at_transmission(&x, z);
  x.transmitted_torque = torque;
  rigid.transmitted_torque = torque;
  half = x;
  half.torsion = 0.5 * x.torsion;
  motor = u->motor_torque - C1 * tanh(x.motor_speed / W1) - B1 * x.motor_speed - at_motor(&x, z) -
          torque / N - torque * kinematics_by_motor(&rigid, z) -
          x.torsion * transmission_by_motor(&half, z);
@load_equation@  dy[0] = x.motor_speed;
  dy[1] = motor / J1;
@load_rates@  memory_rates(&x, z, dy + OWN);
  if (out != 0) {
    out->motor_angle = x.motor_angle;
    out->motor_speed = x.motor_speed;
    out->load_angle = x.load_angle;
    out->load_speed = x.load_speed;
    out->torsion = x.motor_angle / N - x.load_angle;
    out->transmitted_torque = torque;
  }
}
)";

constexpr std::string_view kServoEquations = R"(
/* N (tau_m - J1 N a - losses) - tau - what opposes the gear, with tau = J2 a + load; falls with a. */
static double surplus(instant *x, const double *z, double a, double load_torque) {
  x->transmitted_torque = J2 * a + WEIGHT * sin(x->load_angle) + B2 * x->load_speed +
                          at_load(x, z) + load_torque;
  return N * (x->motor_torque - J1 * N * a - C1 * tanh(x->motor_speed / W1) -
              B1 * x->motor_speed - at_motor(x, z)) -
         x->transmitted_torque - at_transmission(x, z);
}

void @name@_rates(double time, const double *y, const @name@_input *u, double torque_rate, double *dy,
                  @name@_output *out) {
  const double *z = y + OWN;
  instant x = {0};
  double a = 0.0, before = 1.0, left, left_before;
  int k;
  x.time = time;
  x.gear_ratio = N;
  x.load_angle = x.torsion = y[0];
  x.load_speed = x.torsion_rate = y[1];
  x.motor_angle = N * y[0];
  x.motor_speed = N * y[1];
  x.motor_torque = u->motor_torque;
  x.motor_torque_rate = torque_rate;
  /* Friction that grows with the torque transmitted makes the acceleration implicit: secants. */
  left_before = surplus(&x, z, before, u->load_torque);
  for (k = 0; k < 60; ++k) {
    double next;
    left = surplus(&x, z, a, u->load_torque);
    if (left == left_before || left == 0.0) break;
    next = a - left * (a - before) / (left - left_before);
    before = a;
    left_before = left;
    a = next;
    if (fabs(a - before) <= 1e-14 * (fabs(a) + 1.0)) break;
  }
  surplus(&x, z, a, u->load_torque);
  dy[0] = y[1];
  dy[1] = a;
  memory_rates(&x, z, dy + OWN);
  if (out != 0) {
    out->motor_angle = x.motor_angle;
    out->motor_speed = x.motor_speed;
    out->load_angle = x.load_angle;
    out->load_speed = x.load_speed;
    out->torsion = 0.0;
    out->transmitted_torque = x.transmitted_torque;
  }
}
)";

constexpr std::string_view kServoFeedForward = R"(
void @name@_feed_forward(const @name@_desired *d, double *motor_angle, double *motor_torque) {
  const double z[SIZE] = {0.0};
  instant x = {0};
  double rest;
  int k;
  x.gear_ratio = N;
  x.load_angle = x.torsion = d->angle;
  x.load_speed = x.torsion_rate = d->speed;
  x.motor_angle = N * d->angle;
  x.motor_speed = N * d->speed;
  x.transmitted_torque = J2 * d->acceleration + WEIGHT * sin(d->angle) + B2 * d->speed +
                         at_load(&x, z) + d->load_torque;
  rest = J1 * N * d->acceleration + C1 * tanh(x.motor_speed / W1) + B1 * x.motor_speed +
         (x.transmitted_torque + at_transmission(&x, z)) / N;
  *motor_angle = x.motor_angle;
  *motor_torque = rest;
  /* Effects that follow the motor torque, as an error of its constant does: a fixed point. */
  for (k = 0; k < 40; ++k) {
    x.motor_torque = *motor_torque;
    *motor_torque = rest + at_motor(&x, z);
  }
}
)";

constexpr std::string_view kSpecimenEquations = R"(
void @name@_rates(double time, const double *y, const @name@_input *u, double torque_rate, double *dy,
                  @name@_output *out) {
  const double *z = y + OWN;
  instant x = {0};
  (void)torque_rate;
  x.time = time;
  x.gear_ratio = 1.0;
  x.motor_angle = x.load_angle = x.torsion = u->torsion;
  x.motor_speed = x.load_speed = x.torsion_rate = u->torsion_rate;
  x.torsion += kinematics(&x, z);
  x.torsion_rate += kinematics_rate(&x, z);
  x.transmitted_torque = law_f(x.torsion) + law_g_inverse(x.torsion_rate / law_h(x.torsion));
  dy[0] = 0.0;
  memory_rates(&x, z, dy + OWN);
  if (out != 0) {
    out->motor_angle = out->load_angle = out->torsion = u->torsion;
    out->motor_speed = out->load_speed = u->torsion_rate;
    out->transmitted_torque =
        x.transmitted_torque + at_transmission(&x, z) + at_motor(&x, z) + at_load(&x, z);
  }
}
)";

}  // namespace

const CRigText kCFree = {
    4,          kMotorInput,  "motor angle, motor speed, load angle, load speed",
    kTwoMasses, kFeedForward, kFeedForwardSays};
const CRigText kCLocked = {2, kMotorInput, "motor angle, motor speed", kTwoMasses, {}, {}};
const CRigText kCServo = {
    2, kMotorInput, "load angle, load speed", kServoEquations, kServoFeedForward, kFeedForwardSays};
const CRigText kCSpecimen = {
    1, R"(  double torsion;      /* what is imposed */
  double torsion_rate; /* its time derivative */
)", "unused", kSpecimenEquations, {}, {}};

}  // namespace flexspline::data
