#pragma once

namespace flexspline::fuzz {

/// Lets libFuzzer see into the processes that readers by others run in: its counters of code that
/// was reached lie in memory that both share, and what the sanitizers find over there ends this
/// process, too. A signal over there is the library's crash: it is contained, as in the program.
void see_children();

/// Ends this process where the sanitizers have found something in a child.
void check_children();

}  // namespace flexspline::fuzz
