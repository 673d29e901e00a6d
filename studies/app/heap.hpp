#pragma once

namespace flexspline::app {

/// Keeps what is freed for what is allocated next: matrices of a fit come and go by the thousand,
/// and each page that goes back to the system is fetched, and cleared, again.
void keep_freed_memory();

}  // namespace flexspline::app
