#include "derham/core/parallel.hpp"

#include "derham/core/error.hpp"
#include "derham/core/ordered_blocks.hpp"
#include "derham/core/scratch_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace derham {
namespace {

/// Runs every test with 1, 2 and 4 threads.
class Parallel : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { set_thread_count(GetParam()); }
  void TearDown() override { set_thread_count(before_); }

 private:
  int before_ = thread_count();
};
INSTANTIATE_TEST_SUITE_P(ThreadCounts, Parallel, testing::Values(1, 2, 4));

TEST_P(Parallel, PiecesCoverTheRangeOnceAndDependOnTheGrainAlone) {
  for (const Offset size : {1, 7, 8, 9, 1000}) {
    for (const Offset grain : {1, 8, 2000}) {
      std::vector<int> visits(static_cast<std::size_t>(size), 0);
      std::atomic<int> wrong_pieces{0}, pieces{0};
      parallel_blocks(size, grain, [&](Offset begin, Offset end) {
        ++pieces;
        if (begin % grain != 0 || (end != size && end - begin != grain) || end <= begin || end > size) ++wrong_pieces;
        for (Offset i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
      });
      EXPECT_EQ(wrong_pieces, 0);
      EXPECT_EQ(pieces, (size + grain - 1) / grain);
      EXPECT_EQ(visits, std::vector<int>(static_cast<std::size_t>(size), 1)) << "size " << size << ", grain " << grain;
    }
  }
}

TEST_P(Parallel, AnEmptyRangeCallsNothing) {
  for (const Offset size : {0, -3}) parallel_blocks(size, 4, [](Offset, Offset) { FAIL(); });
}

TEST_P(Parallel, AnExceptionReachesTheCallerAndTheNextLoopWorks) {
  for (const Offset culprit : {0, 57, 99}) {
    try {
      parallel_blocks(100, 1, [&](Offset begin, Offset) {
        if (begin == culprit) throw InputError("piece", begin);
      });
      ADD_FAILURE() << "the exception was lost";
    } catch (const InputError& error) {
      EXPECT_EQ(error.row(), culprit);
    }
  }
  EXPECT_THROW(parallel_blocks(100, 1, [](Offset, Offset) { throw std::runtime_error("every piece"); }),
               std::runtime_error);
  std::atomic<Offset> sum{0};
  parallel_blocks(100, 3, [&](Offset begin, Offset end) {
    for (Offset i = begin; i < end; ++i) sum += i;
  });
  EXPECT_EQ(sum, 4950);
}

TEST_P(Parallel, LoopsNest) {
  std::atomic<Offset> count{0};
  parallel_blocks(
      8, 1, [&](Offset, Offset) { parallel_blocks(100, 7, [&](Offset begin, Offset end) { count += end - begin; }); });
  EXPECT_EQ(count, 800);
}

TEST_P(Parallel, ScratchObjectsAreReusedAndNeverShared) {
  std::atomic<int> made{0}, clashes{0};
  struct Scratch {
    std::atomic<bool> taken{false};
  };
  ScratchPool<std::unique_ptr<Scratch>> pool([&] {
    ++made;
    return std::make_unique<Scratch>();
  });
  parallel_blocks(500, 1, [&](Offset, Offset) {
    const auto scratch = pool.take();
    if ((*scratch)->taken.exchange(true)) ++clashes;
    (*scratch)->taken = false;
  });
  EXPECT_EQ(clashes, 0);
  EXPECT_GE(made, 1);
  EXPECT_LE(made, GetParam());
}

TEST_P(Parallel, OrderedBlocksKnowWhatCameBefore) {
  for (const Offset count : {0, 1, 3, 200}) {
    std::atomic<int> made{0};
    std::vector<Offset> before(static_cast<std::size_t>(count), -1), finished(static_cast<std::size_t>(count), -1);
    Offset total = 0, turns = 0;
    ordered_blocks(
        count, [&] { return ++made; }, [&](int&, Offset block) { before[static_cast<std::size_t>(block)] = 0; },
        [&](int&, Offset block) {
          EXPECT_EQ(block, turns++);
          before[static_cast<std::size_t>(block)] = total;
          total += block % 7;
        },
        [&](int&, Offset block) {
          finished[static_cast<std::size_t>(block)] = before[static_cast<std::size_t>(block)] + block % 7;
        });
    EXPECT_EQ(turns, count);
    EXPECT_LE(made, GetParam());
    Offset sum = 0;
    for (Offset block = 0; block < count; ++block) {
      EXPECT_EQ(before[static_cast<std::size_t>(block)], sum);
      sum += block % 7;
      EXPECT_EQ(finished[static_cast<std::size_t>(block)], sum);
    }
  }
}

TEST_P(Parallel, AnExceptionInAnyStepOfAnOrderedBlockReachesTheCaller) {
  for (const int step : {0, 1, 2, 3}) {
    for (const Offset culprit : {0, 31, 99}) {
      const auto fail = [&](int now, Offset block) {
        if (now == step && (block == culprit || now == 0)) throw InputError("block", block);
      };
      EXPECT_THROW(ordered_blocks(
                       100,
                       [&] {
                         fail(0, 0);
                         return 0;
                       },
                       [&](int&, Offset block) { fail(1, block); }, [&](int&, Offset block) { fail(2, block); },
                       [&](int&, Offset block) { fail(3, block); }),
                   InputError);
    }
  }
}

TEST(ThreadCount, MustBePositive) {
  const int before = thread_count();
  EXPECT_GE(before, 1);
  EXPECT_THROW(set_thread_count(0), InputError);
  EXPECT_THROW(set_thread_count(-2), InputError);
  EXPECT_EQ(thread_count(), before);
  set_thread_count(3);
  EXPECT_EQ(thread_count(), 3);
  set_thread_count(before);
}

}  // namespace
}  // namespace derham
