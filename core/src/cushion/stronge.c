/* Stronge's impact of a ball on a compliant nose, planar, in closed form; the default of the
 * simulator pooltool.
 *
 * The nose is two springs: across its surface with the frequency w, along it with ratio w.
 * Friction between them obeys Coulomb's law with mu. With beta = 7/2 (slip against friction
 * impulse), eta^2 = beta / ratio^2, speeds over the approach v_n at the nose, and tau = w t,
 * compression ends at tau = pi/2 and the impact at (1 + e) pi/2. Restitution has the phase phi =
 * tau/e + pi/2 (1 - 1/e), from pi/2 to pi. With rho = |slip| / v_n before the impact, the slip
 * after it is, over v_n,
 *
 *   if it slips to the end        rho - mu beta (1 + e)
 *   if it sticks from tau_k on    U ratio sin(a) + V cos(a) + mu beta e (1 + cos phi(tau_s)),
 *                                 a = ratio (tau_s - tau_k)
 *
 * where U and V are displacement (times w) and speed of the tangential spring at tau_k, and
 * tau_s is where it slips again: its force |U cos(a) - V sin(a) / ratio| has come up to that of
 * friction, mu eta^2 sin phi. It sticks
 *
 *   at once                       rho < mu eta^2
 *   in compression                rho <= mu beta      (rho at the limit: see NEAR)
 *   in restitution                rho <= mu [(1 + e) beta - eta^2/e]
 *   never                         otherwise
 *
 * pooltool tests for "never" first, by the third limit alone. Below e = 1 / ratio that is under
 * the second, and balls that stick in compression are then taken to slip to the end, which can
 * reverse the slip beyond its size and add energy. Its convention copies that.
 *
 * The force is continuous at tau_s, so an error there changes the result to second order only:
 * the zero is located to ROOT_WIDTH, in at most MOST_TRIALS trials. With e = 0 restitution takes
 * no time.
 *
 * Source: W. J. Stronge, Impact Mechanics (Cambridge, 2000), section 5.2. */
#include "cushion/models.h"
#include "platform/elementary.h"

#include <stdbool.h>

static const double BETA = 3.5, HALF_PI = 1.57079632679489661923;
static const double ROOT_WIDTH = 1e-10;
/* how pooltool decides that rho is at a limit */
static const double LIMIT_ABSOLUTE = 1e-8, LIMIT_RELATIVE = 1e-5;
enum { MOST_TRIALS = 60, MOST_HALVINGS = 20 };

/* The impact by its tangential spring, in the symbols of the head. */
typedef struct tangential {
  double mu, e, ratio, eta_squared;
  double end;         /* tau at the end, (1 + e) pi/2 */
  double tau_k, U, V; /* where it sticks: tau, and displacement and speed of the spring */
} tangential;

/* The phase of restitution. */
static double phase(const tangential *spring, double tau) {
  return spring->e > 0 ? tau / spring->e + HALF_PI * (1 - 1 / spring->e) : 2 * HALF_PI;
}

/* By how much friction exceeds the force of the tangential spring: positive while it sticks. */
static double hold(const tangential *spring, double tau) {
  double sine, cosine, sine_phase, unused;
  carom_sincos(spring->ratio * (tau - spring->tau_k), &sine, &cosine);
  carom_sincos(phase(spring, tau), &sine_phase, &unused);
  return spring->mu * spring->eta_squared * sine_phase -
         fabs(spring->U * cosine - spring->V / spring->ratio * sine);
}

/* Where it slips again, in restitution: false position, with a bisection now and then. */
static double slips_again(const tangential *spring) {
  double low = fmax(spring->tau_k, HALF_PI), high = spring->end;
  /* if it has just stuck, `hold` is zero at `low` too, to rounding: go to where it is positive */
  double hold_low = spring->tau_k >= HALF_PI ? 0 : hold(spring, low);
  for (int halving = 1; spring->tau_k >= HALF_PI && halving < MOST_HALVINGS && !(hold_low > 0);
       halving++) {
    low = spring->tau_k + ldexp(high - spring->tau_k, -halving);
    hold_low = hold(spring, low);
  }
  double hold_high = hold(spring, high);
  if (!(hold_low > 0))
    return fmax(spring->tau_k, HALF_PI);
  if (!(hold_high < 0))
    return high;
  for (int trial = 0; trial < MOST_TRIALS && high - low > ROOT_WIDTH; trial++) {
    const double tau = trial % 3 == 2 ? 0.5 * (low + high)
                                      : low + (high - low) * (hold_low / (hold_low - hold_high)),
                 hold_here = hold(spring, tau);
    if (hold_here == 0)
      return tau;
    *(hold_here > 0 ? &low : &high) = tau;
    *(hold_here > 0 ? &hold_low : &hold_high) = hold_here;
  }
  return low + (high - low) * (hold_low / (hold_low - hold_high));
}

/* The state of the tangential spring where it sticks on the way. */
static void stick(tangential *spring, double rho) {
  const double beyond = rho / spring->mu - BETA;
  double sine, cosine;
  if (beyond <= 0) { /* in compression */
    spring->tau_k = carom_acos(fmin(fmax(beyond / (spring->eta_squared - BETA), -1), 1));
    carom_sincos(spring->tau_k, &sine, &cosine);
  } else {
    const double angle = carom_acos(
        fmin(fmax(beyond / (spring->eta_squared / spring->e - spring->e * BETA), -1), 1));
    spring->tau_k = spring->e * (angle - HALF_PI * (1 - 1 / spring->e));
    carom_sincos(angle, &sine, &cosine);
    cosine *= spring->e;
  }
  spring->U = -spring->mu * spring->eta_squared * sine;
  spring->V = rho - spring->mu * BETA * (1 - cosine);
}

/* The slip after the impact, over v_n. */
static double slip_after(double rho, double mu, double e, double ratio, bool pooltool) {
  tangential impact = {.mu = mu,
                       .e = e,
                       .ratio = ratio,
                       .eta_squared = BETA / (ratio * ratio),
                       .end = HALF_PI * (1 + e),
                       .V = rho};
  const double at_once = mu * impact.eta_squared,
               to_the_end = mu * ((1 + e) * BETA - impact.eta_squared / e);
  if (!(mu > 0) || (rho > to_the_end && (pooltool || rho > mu * BETA)))
    return rho - mu * BETA * (1 + e);
  if (rho >= at_once)
    stick(&impact, rho);
  double tau_s;
  if (fabs(rho - at_once) <= LIMIT_ABSOLUTE + LIMIT_RELATIVE * at_once)
    tau_s = HALF_PI;
  else if (rho <= LIMIT_ABSOLUTE ||
           (e > 0 && fabs(rho - to_the_end) <= LIMIT_ABSOLUTE + LIMIT_RELATIVE * to_the_end))
    tau_s = impact.end;
  else
    tau_s = slips_again(&impact);
  double sine, cosine, unused, cosine_phase;
  carom_sincos(ratio * (tau_s - impact.tau_k), &sine, &cosine);
  carom_sincos(phase(&impact, tau_s), &unused, &cosine_phase);
  return ratio * impact.U * sine + impact.V * cosine + mu * BETA * e * (1 + cosine_phase);
}

/* The fraction of the slip that friction takes, over the mass. */
static double friction_share(const carom_contact *contact, double v_n, double slip,
                             const carom_cushion_options *opt) {
  const bool pooltool = opt->convention == CAROM_CONVENTION_POOLTOOL;
  const double ratio = carom_or_usual(opt->omega_ratio, CAROM_USUAL_OMEGA_RATIO);
  const double rho = slip / v_n;
  return slip > 0 ? (1 - slip_after(rho, contact->mu_w, contact->e, ratio, pooltool) / rho) / BETA
                  : 0;
}

double carom_stronge_friction(const carom_contact *contact, double v_n, double slip,
                              const carom_cushion_options *opt) {
  return friction_share(contact, v_n, slip, opt) * slip;
}

carom_status carom_stronge(carom_contact *contact, const carom_cushion_options *opt) {
  const double s_x = carom_slip_x(contact), s_t = carom_slip_t(contact),
               slip = sqrt(s_x * s_x + s_t * s_t), v_n = contact->v_y * contact->cosine;
  const double share = friction_share(contact, v_n, slip, opt);
  const carom_impulse impulse = {
      .P = (1 + contact->e) * v_n, .f_x = -share * s_x, .f_t = -share * s_t};
  carom_push(contact, &impulse);
  return CAROM_OK;
}
