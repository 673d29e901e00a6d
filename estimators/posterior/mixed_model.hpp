#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace flexspline::estimators {

/// Columns of a mixed model that share a prior variance, by what of them is normal with it: the
/// sums of neighbours from `first` on with the weights of `rows`, one a row, or, where these are
/// none, the coefficients themselves. precision: 1/variance; it is estimated unless held.
struct PriorGroup {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
  std::vector<std::array<double, 3>> rows{};
  double precision = 1.0;
  bool held = false;
  int family = 0;  ///< groups of one spline; 0: a group on its own
};

struct MixedPosterior {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// Normal law of c given y = J c + e, e of unit variance, with A = J'J and b = J'y.
MixedPosterior posterior_of(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
                            const std::vector<PriorGroup>& groups);

/// Restricted maximum likelihood of the precisions by the fixed-point iteration of Fellner and
/// Schall (Wood and Fasiolo, Biometrics 73, 2017), at most `rounds`. The second differences of a
/// spline in groups of their own make its roughness local; the precision of a group has a gamma law
/// of a third of a degree of freedom about that of its spline as a whole, so that a stretch that
/// happens to look straight is not taken for one. Returns the posterior at the end.
MixedPosterior restricted_likelihood(const Eigen::MatrixXd& information,
                                     const Eigen::VectorXd& gradient,
                                     std::vector<PriorGroup>& groups, int rounds);

/// Covariance of c where the precisions are not known but estimated: with the mean moving by
/// dc/d ln l_j = -l_j V D_j'D_j c, V + M W M', W the inverse of the expected information on ln l
/// (Kass and Steffey, JASA 84, 1989; Wood, Pya and Saefken, JASA 111, 2016). To first order.
Eigen::MatrixXd unconditional_covariance(const MixedPosterior& posterior,
                                         const std::vector<PriorGroup>& groups);

}  // namespace flexspline::estimators
