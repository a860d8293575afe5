#include "derham/core/kept.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace derham {
namespace {

TEST(KeptValues, AreMadeOnceByWhoeverAsksFirst) {
  const Kept<std::vector<int>> kept;
  std::atomic<int> made{0};
  std::vector<const std::vector<int>*> seen(8);
  std::vector<std::thread> threads;
  for (auto& place : seen)
    threads.emplace_back([&] {
      place = &kept.get([&] {
        ++made;
        return std::vector<int>{1, 2, 3};
      });
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
  for (const auto* place : seen) EXPECT_EQ(place, seen[0]);
  EXPECT_EQ(*seen[0], (std::vector<int>{1, 2, 3}));
}

TEST(KeptValues, AreMadeByTheNextWhenMakingFailed) {
  const Kept<int> kept;
  const auto fail = []() -> int { throw std::runtime_error("no"); };
  EXPECT_THROW(kept.get(fail), std::runtime_error);
  EXPECT_THROW(kept.get(fail), std::runtime_error);
  EXPECT_EQ(kept.get([] { return 7; }), 7);
  EXPECT_EQ(kept.get(fail), 7);
}

}  // namespace
}  // namespace derham
