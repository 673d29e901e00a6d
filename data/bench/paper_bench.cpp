#include <utility>

#include "bench/table_one.hpp"
#include "flexspline/data/bench.hpp"

namespace flexspline::data {

RecordingSet paper_bench(std::string name, std::vector<Recording> recordings) {
  RecordingSet set;
  set.name = std::move(name);
  set.rig = Rig::locked;
  set.license = "CC0-1.0";
  set.source = "virtual bench after Dhaouadi and Ghorbel (2003), output locked";
  set.constants = {{"gear_ratio", kPaperGearRatio},
                   {"motor_inertia_kgm2", 0.726e-3},
                   {"rated_torque_nm", 226.0}};
  set.display = {"deg", "Nm"};
  set.recordings = std::move(recordings);
  return set;
}

}  // namespace flexspline::data
