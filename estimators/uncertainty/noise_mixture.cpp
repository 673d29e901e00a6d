#include "uncertainty/noise_mixture.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <boost/math/distributions/students_t.hpp>

namespace flexspline::estimators {
namespace {

constexpr int kGrid = 25;             // points along share and along ln time
constexpr double kNegligible = 18.0;  // rise of the deviance beyond which there is no weight
constexpr int kDraws = 1500;          // combinations of several outputs' noises
constexpr double kTail = 0.025;
constexpr int kHalvings = 60;

/// What one output says of the parameters at one of its noises, in units of its variance.
struct Component {
  double weight = 0.0;
  OtherInformation says;
};

/// A range of share and ln time outside which nothing is likely.
struct Box {
  double low[2];
  double high[2];
};

class OutputNoiseLaw {
 public:
  OutputNoiseLaw(const std::vector<TimedSeries>& series, OtherInformation other,
                 const ColouredNoise& at)
      : series_(series), other_(std::move(other)), best_{at.share, std::log(at.time)} {}

  std::vector<Component> components() const {
    const Box box = likely_box();
    std::vector<Component> list;
    std::vector<double> deviances;
    for (int s = 0; s < kGrid; ++s) {
      for (int t = 0; t < kGrid; ++t) {
        const double share = at(box, 0, s);
        const double time = std::exp(at(box, 1, t));
        const auto here = likelihood_of(series_, other_, share, time);
        Component one{0.0, information_of(series_, {1.0, share, time})};
        const double variance = here.noise.sigma * here.noise.sigma;
        one.says.information /= variance;
        one.says.gradient /= variance;
        list.push_back(std::move(one));
        deviances.push_back(here.deviance);
      }
    }
    const double least = *std::ranges::min_element(deviances);
    double sum = 0.0;
    for (std::size_t k = 0; k < list.size(); ++k) {
      list[k].weight = std::exp(-0.5 * (deviances[k] - least));
      sum += list[k].weight;
    }
    for (Component& one : list) one.weight /= sum;
    std::erase_if(list, [](const Component& one) { return one.weight < 1e-9; });
    return list;
  }

 private:
  static double at(const Box& box, int axis, int k) {
    return box.low[axis] + (box.high[axis] - box.low[axis]) * (k + 0.5) / kGrid;
  }

  double deviance(const double (&x)[2]) const {
    return likelihood_of(series_, other_, x[0], std::exp(x[1])).deviance;
  }

  /// Along each axis, with the other at its best, as far as anything is likely; twice that, since
  /// the two depend on each other.
  Box likely_box() const {
    const NoiseRange range = noise_range(series_);
    const Box whole{{0.0, std::log(range.shortest)},
                    {range.largest_share, std::log(range.longest)}};
    const double least = deviance(best_);
    Box box = whole;
    for (int axis = 0; axis < 2; ++axis) {
      const double width = whole.high[axis] - whole.low[axis];
      for (const double way : {-1.0, 1.0}) {
        double x[2] = {best_[0], best_[1]};
        double reach = 1e-3 * width;
        for (; reach < width; reach *= 1.5) {
          x[axis] = std::clamp(best_[axis] + way * reach, whole.low[axis], whole.high[axis]);
          if (deviance(x) - least > kNegligible) break;
        }
        const double end =
            std::clamp(best_[axis] + 2.0 * way * reach, whole.low[axis], whole.high[axis]);
        (way < 0.0 ? box.low : box.high)[axis] = end;
      }
    }
    return box;
  }

  const std::vector<TimedSeries>& series_;
  OtherInformation other_;
  double best_[2];
};

/// The law of the parameters at one noise of every output: about a shift, with these deviations.
struct Member {
  double weight = 0.0;
  Eigen::VectorXd shift;
  Eigen::VectorXd deviation;
};

Member member_of(const OtherInformation& says, double weight) {
  const Eigen::Index n = says.gradient.size();
  const Eigen::LDLT<Eigen::MatrixXd> solved(says.information);
  const Eigen::MatrixXd inverse = solved.solve(Eigen::MatrixXd::Identity(n, n));
  return {weight, -solved.solve(says.gradient), inverse.diagonal().cwiseMax(0.0).cwiseSqrt()};
}

/// Radical inverse: even draws without randomness.
double halton(int index, int base) {
  double fraction = 1.0;
  double result = 0.0;
  for (int i = index; i > 0; i /= base) {
    fraction /= base;
    result += fraction * (i % base);
  }
  return result;
}

const Component& drawn(const std::vector<Component>& list, double u) {
  for (const Component& one : list) {
    u -= one.weight;
    if (u <= 0.0) return one;
  }
  return list.back();
}

std::vector<Member> members_of(const std::vector<std::vector<Component>>& outputs) {
  std::vector<Member> members;
  if (outputs.size() == 1) {
    for (const Component& one : outputs.front()) members.push_back(member_of(one.says, one.weight));
    return members;
  }
  constexpr int kPrimes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29};
  for (int k = 1; k <= kDraws; ++k) {
    OtherInformation sum;
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      const Component& one = drawn(outputs[o], halton(k, kPrimes[o % std::size(kPrimes)]));
      if (o == 0) {
        sum = one.says;
        continue;
      }
      sum.information += one.says.information;
      sum.gradient += one.says.gradient;
    }
    members.push_back(member_of(sum, 1.0 / kDraws));
  }
  return members;
}

double quantile_of(const std::vector<Member>& members, Eigen::Index k, double freedom,
                   double probability) {
  const boost::math::students_t_distribution<> law(freedom);
  double reach = 0.0;
  for (const Member& one : members)
    reach = std::max(reach, std::abs(one.shift[k]) + 50.0 * one.deviation[k]);
  double low = -reach;
  double high = reach;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    double below = 0.0;
    for (const Member& one : members)
      below += one.weight * boost::math::cdf(law, (middle - one.shift[k]) / one.deviation[k]);
    (below < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

NoiseMixture over_noise(const std::vector<std::vector<TimedSeries>>& outputs,
                        const std::vector<ColouredNoise>& at, double freedom) {
  const Eigen::Index n = outputs.front().front().slope.cols();
  std::vector<std::vector<Component>> components;
  for (std::size_t o = 0; o < outputs.size(); ++o) {
    OtherInformation other{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
    for (std::size_t p = 0; p < outputs.size(); ++p) {
      if (p == o) continue;
      const auto one = information_of(outputs[p], at[p]);
      other.information += one.information;
      other.gradient += one.gradient;
    }
    if (at[o].share > 0.0) {
      components.push_back(OutputNoiseLaw(outputs[o], other, at[o]).components());
    } else {
      components.push_back({Component{1.0, information_of(outputs[o], at[o])}});
    }
  }
  const auto members = members_of(components);
  NoiseMixture result{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    double mean = 0.0;
    double square = 0.0;
    for (const Member& one : members) {
      mean += one.weight * one.shift[k];
      square += one.weight * (one.shift[k] * one.shift[k] + one.deviation[k] * one.deviation[k]);
    }
    result.std[k] = std::sqrt(std::max(0.0, square - mean * mean));
    result.lower[k] = quantile_of(members, k, freedom, kTail);
    result.upper[k] = quantile_of(members, k, freedom, 1.0 - kTail);
  }
  return result;
}

}  // namespace flexspline::estimators
