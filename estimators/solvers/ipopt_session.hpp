#pragma once

#include <functional>
#include <string>

#include <IpIpoptApplication.hpp>

#include "flexspline/core/error.hpp"

namespace flexspline::estimators {

/// Runs one problem through Ipopt, silent and without reading ipopt.opt. `configure` sets options
/// beside those that Debian's MUMPS needs. MUMPS keeps its state in globals, and two solves in two
/// threads crash; so one process-wide mutex is held during each, which protects only as long as
/// every use of Ipopt in the program comes through here. Callbacks may use threads of their own.
/// Errors: defect, where Ipopt cannot be set up, and numerics, where it ran out of memory.
Result<Ipopt::ApplicationReturnStatus> run_ipopt(
    const Ipopt::SmartPtr<Ipopt::TNLP>& problem,
    const std::function<void(Ipopt::OptionsList&)>& configure);

/// What a status means, in words.
std::string words_of(Ipopt::ApplicationReturnStatus status);

}  // namespace flexspline::estimators
