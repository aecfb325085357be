// Work shared by threads, its results taken in order.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace plumbline::cli {

/// work(mine, i) for each i of `begin`, which are 0 to n - 1 in the order in which they are begun, by this thread,
/// whose own things are `first`, and by `others` more beside it, each with things of its own by make(). take(result)
/// for each from 0 on and one at a time, as soon as all before it are there, by any of the threads. Throws what the
/// first of them threw, from 0 on: nothing after it is begun then, and what was begun is done.
template <class Own, class Make, class Work, class Take>
void in_order(std::span<const std::size_t> begin, Own& first, std::size_t others, const Make& make, const Work& work,
              const Take& take) {
  const std::size_t n = begin.size();
  struct Done {
    std::optional<std::invoke_result_t<const Work&, Own&, std::size_t>> result;
    std::exception_ptr failure;
  };
  std::vector<Done> done(n);
  std::atomic<std::size_t> next = 0, end = n;  // places in `begin`; the least that is not wanted any more
  const auto end_at = [&](std::size_t i) {
    for (std::size_t was = end; i < was && !end.compare_exchange_weak(was, i);) {
    }
  };
  std::mutex taking, making;
  std::size_t taken = 0;
  std::exception_ptr failure;
  const auto finish = [&](std::size_t i, Done made) {
    const std::scoped_lock lock(taking);
    done[i] = std::move(made);
    try {
      for (; !failure && taken < n && (done[taken].result || done[taken].failure); ++taken) {
        Done now = std::exchange(done[taken], {});
        if (now.failure) std::rethrow_exception(now.failure);
        take(std::move(*now.result));
      }
    } catch (...) {
      failure = std::current_exception();
      end_at(0);
    }
  };
  const auto run = [&](Own* mine) {
    std::optional<Own> made_here;
    for (std::size_t place = next++; place < n; place = next++) {
      const std::size_t i = begin[place];
      if (i >= end) continue;
      Done made;
      try {
        if (mine == nullptr) {
          const std::scoped_lock lock(making);
          mine = &made_here.emplace(make());
        }
        made.result = work(*mine, i);
      } catch (...) {
        made.failure = std::current_exception();
        end_at(i);
      }
      finish(i, std::move(made));
    }
  };
  {
    std::vector<std::jthread> threads;
    try {
      while (threads.size() < others) threads.emplace_back(run, nullptr);
    } catch (const std::system_error&) {  // fewer do it, too
    }
    run(&first);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace plumbline::cli
