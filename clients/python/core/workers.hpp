// Work for many items without the interpreter's lock, by several threads, that Ctrl-C ends.
//
//   for_each_index(shots.size(), threads, [&](std::size_t i, const Stop& stop) { ... });
//
// The job must not touch Python. The order of items does not matter; each is done once.
#pragma once

#include <cstddef>
#include <functional>

namespace poolhall::python {

// Whether to leave off, for a long job to ask now and then; from any thread.
using Stop = std::function<bool()>;
using Job = std::function<void(std::size_t, const Stop&)>;

// 0 is one a core that this process may run on.
[[nodiscard]] unsigned thread_count(unsigned asked);

// Is called with the interpreter's lock and holds it again on return. The caller is one of the
// threads. Rethrows what a job threw, and raises what a signal handler raised (KeyboardInterrupt)
// once all threads have stopped.
void for_each_index(std::size_t count, unsigned threads, const Job& job);

}  // namespace poolhall::python
