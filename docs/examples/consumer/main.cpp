// Reads a data set and fits the torsion law tau = f(phi) + g^-1(phi'/h(phi)) to all of its
// recordings: consumer DATASET ESTIMATOR.
#include <iostream>
#include <utility>

#include <flexspline/core/torsion_record.hpp>
#include <flexspline/data/dataset.hpp>
#include <flexspline/estimators/method.hpp>

namespace {

int refuse(const flexspline::Error& error) {
  std::cerr << error.message() << '\n';
  return static_cast<int>(error.code);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace flexspline;
  if (argc != 3) {
    std::cerr << "usage: consumer DATASET ESTIMATOR\n";
    return 2;
  }
  const auto set = data::load_dataset(argv[1]);
  if (!set) return refuse(set.error());
  const auto method = estimators::find_method(argv[2]);
  if (!method) return refuse(method.error());

  auto records = torsion_records(*set);
  if (!records) return refuse(records.error());
  estimators::FitProblem problem;
  problem.records = std::move(*records);
  const auto estimate = (*method)->fit(problem);
  if (!estimate) return refuse(estimate.error());
  for (const auto& one : estimate->parameters) {
    std::cout << one.name << " = " << one.value << " +- " << one.std << ' ' << one.unit << '\n';
  }
  std::cout << (*method)->id << ": " << estimate->parameters.size() << " parameters, cost "
            << estimate->cost << '\n';
}
