// Work shared by threads (src/cli/in_order.h).
#include "cli/in_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <latch>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace plumbline::cli {
namespace {

constexpr std::size_t kMany = 60, kMost = 1000;

// The first of each three takes longer than those after it.
void linger(std::size_t i) { std::this_thread::sleep_for(std::chrono::microseconds(i % 3 == 0 ? 3000 : 100)); }

std::vector<std::size_t> numbers(std::size_t n) {
  std::vector<std::size_t> out(n);
  std::iota(out.begin(), out.end(), std::size_t{0});
  return out;
}

// The things of a thread, which waits in its first work until all threads are at theirs.
struct Own {
  int number = 0;
  bool began = false;
};
void wait_for_all(std::latch& all, Own& mine) {
  if (std::exchange(mine.began, true)) return;
  all.count_down();
  for (int ms = 0; ms < 10000 && !all.try_wait(); ++ms) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(InOrder, results_are_taken_in_order_whoever_makes_them_of_whose_things) {
  for (const int others : {0, 1, 4}) {
    Own first;
    std::latch all(others + 1);
    std::atomic<int> made = 0, busy = 0;
    std::vector<std::size_t> taken;
    std::map<int, std::set<std::thread::id>> users;
    const auto make = [&] { return Own{++made}; };
    const auto work = [&](Own& mine, std::size_t i) {
      EXPECT_LE(++busy, others + 1);
      wait_for_all(all, mine);
      linger(i);
      --busy;
      return std::tuple(i, mine.number, std::this_thread::get_id());
    };
    const auto take = [&](std::tuple<std::size_t, int, std::thread::id> result) {
      taken.push_back(std::get<0>(result));
      users[std::get<1>(result)].insert(std::get<2>(result));
    };
    std::vector<std::size_t> begin = numbers(kMany);
    if (others > 1) std::ranges::reverse(begin);
    in_order(begin, first, static_cast<std::size_t>(others), make, work, take);
    EXPECT_EQ(taken, numbers(kMany));
    EXPECT_TRUE(all.try_wait()) << "they worked at a time";
    EXPECT_EQ(made, others);
    EXPECT_EQ(users.size(), static_cast<std::size_t>(others + 1));
    for (const auto& [things, threads] : users) EXPECT_EQ(threads.size(), 1u) << things;
    EXPECT_EQ(users[0], std::set{std::this_thread::get_id()});
  }
}

// What was taken, the words of what was thrown, and how much was begun.
struct Ended {
  std::vector<std::size_t> taken;
  std::string says;
  std::size_t begun = 0;
};
template <class Make, class Work, class Take>
Ended ended(std::size_t others, const Make& make, const Work& work, const Take& take,
            const std::vector<std::size_t>& begin = numbers(kMost)) {
  Ended out;
  std::atomic<std::size_t> begun = 0;
  int first = 0;
  try {
    in_order(
        begin, first, others, make,
        [&](int&, std::size_t i) {
          ++begun;
          linger(i);
          work(i);
          return i;
        },
        [&](std::size_t i) {
          take(i);
          out.taken.push_back(i);
        });
  } catch (const std::runtime_error& e) {
    out.says = e.what();
  }
  out.begun = begun;
  return out;
}

void fail_at(std::initializer_list<std::size_t> bad, std::size_t i) {
  if (std::ranges::count(bad, i) > 0) throw std::runtime_error(std::to_string(i));
}

TEST(InOrder, the_first_failure_in_order_ends_it) {
  const auto zero = [] { return 0; };
  const auto nothing = [](std::size_t) {};
  for (const std::size_t others : {0u, 1u, 4u}) {
    // 9 takes longer than 10 and 11, which fail before it does.
    Ended end = ended(
        others, zero,
        [](std::size_t i) {
          fail_at({9, 10, 11}, i);
        },
        nothing);
    EXPECT_EQ(end.says, "9");
    EXPECT_EQ(end.taken, numbers(9)) << "all before it were done";
    EXPECT_LT(end.begun, others == 0 ? 11 : kMost) << "no more is begun";
    end = ended(others, zero, nothing, [](std::size_t i) { fail_at({7}, i); });
    EXPECT_EQ(end.says, "7");
    EXPECT_EQ(end.taken, numbers(7)) << "nothing is taken after it";
    EXPECT_LT(end.begun, others == 0 ? 9 : kMost);
  }
  // What is begun before them fails after them, or not at all; all before the first are done.
  std::vector<std::size_t> begin = numbers(kMost);
  std::swap(begin[0], begin[800]);
  std::swap(begin[1], begin[9]);
  for (const std::size_t others : {0u, 1u, 4u}) {
    const Ended end = ended(
        others, zero,
        [](std::size_t i) {
          fail_at({800, 9, 10}, i);
        },
        nothing, begin);
    EXPECT_EQ(end.says, "9");
    EXPECT_EQ(end.taken, numbers(9));
    EXPECT_LT(end.begun, kMost);
  }
  const Ended end = ended(
      2, [] { return throw std::runtime_error("no things"), 0; }, nothing, nothing);
  EXPECT_EQ(end.says, "no things");
}

TEST(InOrder, nothing_to_do_is_done) {
  int first = 0, taken = 0;
  in_order(
      {}, first, 2, [] { return 0; }, [](int&, std::size_t i) { return i; }, [&](std::size_t) { ++taken; });
  EXPECT_EQ(taken, 0);
}

}  // namespace
}  // namespace plumbline::cli
