#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace flexspline::estimators {

/// Noise of a measured series: a first-order process (in even steps an AR(1)) beside white noise.
struct ColouredNoise {
  double sigma = 1.0;  ///< of both together
  double share = 0.0;  ///< of the variance that is the first-order process, 0: all white
  double time = 0.0;   ///< over which its correlation falls to 1/e; 0 where share is
};

/// One series of residuals with its instants, increasing.
struct TimedSeries {
  std::vector<double> time;
  std::vector<double> value;
  Eigen::MatrixXd slope{};  ///< by the parameters that were fitted to it, a row an instant
};

/// What other measurements say of the same parameters, at unit variance: J'J and J'r.
struct OtherInformation {
  Eigen::MatrixXd information{};
  Eigen::VectorXd gradient{};
};

/// Maximum likelihood over all series, by the prediction errors of the scalar Kalman filter
/// (Schweppe 1965); restricted (Patterson and Thompson 1971) where slopes are given, since the
/// parameters took some of the noise with them, of slow noise most. White where a colour gains less
/// than the Bayesian criterion asks of two parameters.
ColouredNoise estimate_noise(std::span<const TimedSeries> series,
                             const OtherInformation& other = {});

/// How likely noise of a share and a time is: with the sigma that suits best, and minus twice the
/// (restricted) log-likelihood, up to a constant that all points of the same series share.
struct NoiseLikelihood {
  ColouredNoise noise;
  double deviance = 0.0;
};
NoiseLikelihood likelihood_of(std::span<const TimedSeries> series, const OtherInformation& other,
                              double share, double time);

/// Times that are worth looking at: from a tenth of the interval of samples to twice the longest
/// series. Largest share: the rest keeps the filter regular.
struct NoiseRange {
  double shortest = 0.0;
  double longest = 0.0;
  double largest_share = 0.0;
};
NoiseRange noise_range(std::span<const TimedSeries> series);

/// J'J and J'r of series in such noise.
OtherInformation information_of(std::span<const TimedSeries> series, const ColouredNoise& noise);

/// Turns residuals into the innovations of such noise over their standard deviations: independent
/// and of unit variance, so that their least squares is maximum likelihood. Linear, so Jacobians
/// pass through it as well.
class WhiteningFilter {
 public:
  WhiteningFilter(const ColouredNoise& noise, std::span<const double> times);

  std::size_t size() const { return steps_.size(); }
  /// In place.
  void whiten(std::span<double> series) const;
  /// In place, every column of a matrix with a row an instant.
  void whiten(Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>
                  rows) const;
  struct Step {
    double transition;  ///< of the process since the last instant
    double update;      ///< share of an innovation that goes into it
    double weight;      ///< 1 / standard deviation of the innovation
  };
  const Step& step(std::size_t k) const { return steps_[k]; }
  /// Sum of ln of the innovations' variances.
  double log_variance() const;

 private:
  std::vector<Step> steps_;
};

}  // namespace flexspline::estimators
