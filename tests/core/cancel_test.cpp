#include "derham/core/cancel.hpp"

#include "derham/core/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace derham {
namespace {

std::atomic<int> calls, calls_elsewhere;
std::atomic<bool> stop;
std::thread::id caller;

void check() {
  ++calls;
  if (std::this_thread::get_id() != caller) ++calls_elsewhere;
  if (stop) throw Cancelled("stopped");
}

/// Runs every test with 1, 2 and 4 threads.
class Cancel : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    set_thread_count(GetParam());
    calls = calls_elsewhere = 0;
    stop = false;
    caller = std::this_thread::get_id();
    std::this_thread::sleep_for(std::chrono::milliseconds(110));  // the last call of another test is long ago
    set_cancel_check(check);
  }
  void TearDown() override {
    set_cancel_check(nullptr);
    set_thread_count(before_);
  }

 private:
  int before_ = thread_count();
};
INSTANTIATE_TEST_SUITE_P(ThreadCounts, Cancel, testing::Values(1, 2, 4));

/// A block that takes a millisecond.
void wait_block(Offset, Offset) { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

TEST_P(Cancel, StopsAParallelLoopAndTheNextOneWorks) {
  EXPECT_THROW(parallel_blocks(60'000, 1,
                               [](Offset begin, Offset end) {
                                 wait_block(begin, end);
                                 stop = true;
                               }),
               Cancelled);
  EXPECT_GT(calls, 0);
  EXPECT_EQ(calls_elsewhere, 0) << "only the thread that began the loop asks";
  stop = false;
  std::atomic<Offset> sum{0};
  parallel_blocks(100, 1, [&](Offset begin, Offset) { sum += begin; });
  EXPECT_EQ(sum, 99 * 100 / 2);
}

TEST_P(Cancel, StopsLoopsWithinLoops) {
  std::atomic<Offset> finished_here{0};
  EXPECT_THROW(parallel_blocks(1000, 1,
                               [&](Offset, Offset) {
                                 stop = true;  // asked for at the first block, and 0.1 s later
                                 parallel_blocks(200, 1, wait_block);
                                 if (std::this_thread::get_id() == caller) ++finished_here;
                               }),
               Cancelled);
  EXPECT_EQ(finished_here, 0);
  EXPECT_EQ(calls_elsewhere, 0);
}

TEST_P(Cancel, AsksTenTimesASecond) {
  poll_cancel();
  EXPECT_EQ(calls, 1);
  for (int i = 0; i < 1000; ++i) poll_cancel();
  EXPECT_LE(calls, 2) << "or a thousand polls took 0.1 s";
  std::this_thread::sleep_for(std::chrono::milliseconds(110));
  poll_cancel();
  EXPECT_GE(calls, 2);
}

TEST_P(Cancel, NothingIsAskedWithoutACheck) {
  set_cancel_check(nullptr);
  stop = true;
  EXPECT_NO_THROW(poll_cancel());
  EXPECT_EQ(calls, 0);
  EXPECT_STREQ(Cancelled("stopped").kind(), "cancelled");
}

}  // namespace
}  // namespace derham
