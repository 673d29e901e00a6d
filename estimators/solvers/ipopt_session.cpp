#include "solvers/ipopt_session.hpp"

#include <exception>
#include <mutex>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace flexspline::estimators {
namespace {

std::mutex& mumps_mutex() {
  static std::mutex mutex;
  return mutex;
}

// With its default scaling Debian's MUMPS regularises large problems to a wrong point, and its
// default ordering takes minutes where a few columns are dense.
void set_defaults(Ipopt::OptionsList& options) {
  options.SetIntegerValue("print_level", 0);
  options.SetStringValue("sb", "yes");
  options.SetStringValue("linear_solver", "mumps");
  options.SetIntegerValue("mumps_permuting_scaling", 0);
  options.SetIntegerValue("mumps_pivot_order", 6);
}

// While it lives, what is freed goes back to the system: MUMPS' factors are most of the memory of a
// fit, and neither what reading the data left nor Ipopt's copies of the matrices should add to
// them.
class ThriftyHeap {
 public:
  ThriftyHeap() {
#ifdef __GLIBC__
    malloc_trim(0);
    mallopt(M_MMAP_THRESHOLD, 128 << 10);
#endif
  }
  ~ThriftyHeap() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
#endif
  }
  ThriftyHeap(const ThriftyHeap&) = delete;
  ThriftyHeap& operator=(const ThriftyHeap&) = delete;
};

}  // namespace

Result<Ipopt::ApplicationReturnStatus> run_ipopt(
    const Ipopt::SmartPtr<Ipopt::TNLP>& problem,
    const std::function<void(Ipopt::OptionsList&)>& configure) {
  const std::lock_guard lock(mumps_mutex());
  const ThriftyHeap thrifty;
  try {
    const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
    set_defaults(*application->Options());
    configure(*application->Options());
    if (application->Initialize("") != Ipopt::Solve_Succeeded) {
      return failure(ErrorCode::defect, "Ipopt does not accept its options");
    }
    return application->OptimizeTNLP(problem);
  } catch (const std::exception& error) {
    return failure(ErrorCode::numerics, std::string("Ipopt stopped: ") + error.what(),
                   "fit fewer parameters or samples");
  }
}

std::string words_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
    case Ipopt::Solved_To_Acceptable_Level:
      return "converged";
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return "the steps became too small to matter";
    case Ipopt::Infeasible_Problem_Detected:
      return "no point meets the constraints";
    case Ipopt::Diverging_Iterates:
      return "the parameters run off to infinity";
    case Ipopt::User_Requested_Stop:
      return "stopped from outside";
    case Ipopt::Maximum_Iterations_Exceeded:
    case Ipopt::Maximum_CpuTime_Exceeded:
      return "out of iterations";
    case Ipopt::Restoration_Failed:
    case Ipopt::Error_In_Step_Computation:
      return "no step improves on the point reached";
    case Ipopt::Invalid_Number_Detected:
      return "the problem cannot be evaluated";
    case Ipopt::Insufficient_Memory:
      return "out of memory";
    default:
      return "Ipopt failed with status " + std::to_string(static_cast<int>(status));
  }
}

}  // namespace flexspline::estimators
