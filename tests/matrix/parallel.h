// Jobs on threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace plumbline::matrix {

/// Runs job(0) to job(n - 1), each once, on `workers` threads. After the last one, rethrows the exception of the first
/// job, by number, that threw.
void in_parallel(std::size_t n, unsigned workers, const auto& job) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> errors(n);
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < workers; ++i) {
      threads.emplace_back([&] {
        for (std::size_t k = next++; k < n; k = next++) {
          try {
            job(k);
          } catch (...) {
            errors[k] = std::current_exception();
          }
        }
      });
    }
  }
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace plumbline::matrix
