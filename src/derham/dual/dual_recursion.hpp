#pragma once

#include "derham/boundary/scatter_pieces.hpp"
#include "derham/complex/local_faces.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/cancel.hpp"
#include "derham/core/large_pages.hpp"
#include "derham/core/parallel.hpp"
#include "derham/dual/settled_block.hpp"
#include "derham/geometry/block_metric.hpp"
#include "derham/geometry/pack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

// Internal to dual and hodge.
namespace derham::detail {

/// A dual volume as far as it has been summed up, and what the errors of the heights in it may amount to. Side by side, so
/// that adding to both is one operation and one access to memory.
struct alignas(16) Estimate {
  double value, error;
};

/// Zeros, which the system provides: nothing is written here.
class Sums {
 public:
  Sums() = default;
  explicit Sums(std::size_t size)
      : data_(static_cast<Estimate*>(std::calloc(std::max<std::size_t>(size, 1), sizeof(Estimate)))) {
    if (!data_) throw std::bad_alloc();
    prefer_large_pages(data_.get(), size * sizeof(Estimate));
  }
  [[nodiscard]] Estimate* data() const noexcept { return data_.get(); }

 private:
  struct Free {
    void operator()(Estimate* memory) const noexcept { std::free(memory); }
  };
  std::unique_ptr<Estimate, Free> data_;
};

/// How many pieces the recursion is cut into.
template <int n>
[[nodiscard]] std::size_t dual_pieces(const SimplicialComplex<n>& K) {
  constexpr Index fewest = 2048;  // simplices that are worth a thread
  return static_cast<std::size_t>(std::clamp<Index>(K.size(n) / fewest, 1, thread_count()));
}

/// The recursion for circumcentric dual volumes from the top degree to the vertices (circumcentric.hpp). Every simplex
/// is measured, and gives its share to its faces. sink.template take<k>(piece, SettledBlock) hears of each simplex once;
/// calls for different pieces, numbered from 0 to dual_pieces(K)-1 for every degree, come from several threads, and the
/// simplices of a piece are increasing and come before those of the next.
///
/// Threads own ranges of the faces that shares go to, and each adds up its own in the order of the simplices: the same
/// bits for any number of threads. A simplex with faces in several ranges is measured in each; where most are, one thread does all.
template <int n, class Sink>
class DualRecursion {
 public:
  DualRecursion(const SimplicialComplex<n>& K, const Geometry<n>& geometry, Sink& sink)
      : complex_(K), metric_(K, geometry), sink_(sink), parts_(dual_pieces<n>(K)) {}

  void run() {
    unrolled<n>([&]<int i>() { add_shares<n - i>(); });
    settle_vertices();
  }

  /// Degenerate top simplices, increasing.
  [[nodiscard]] std::vector<Index> degenerate() const {
    std::vector<Index> result;
    for (const Part& part : parts_) result.insert(result.end(), part.degenerate.begin(), part.degenerate.end());
    return result;
  }

  /// Every simplex of every degree contains its circumcentre in its interior.
  [[nodiscard]] bool well_centered() const {
    return std::ranges::all_of(parts_, [](const Part& part) { return part.centered && part.degenerate.empty(); });
  }

 private:
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  static constexpr double height_error = 1e-10;  // relative to a height that is not zero

  struct Part {
    std::vector<Index> degenerate;
    bool centered = true;
  };

  /// The simplices that a thread treats together.
  template <int k>
  struct Work {
    using Block = MetricBlock<k>;
    static constexpr auto capacity = static_cast<std::size_t>(Block::capacity);

    Block metric;
    std::array<Index, capacity> simplex{};
    std::size_t count = 0;
    bool shared = false;  // with other pieces, some of them
    typename Block::Row dual{}, value{}, slope{}, least{};
  };

  template <int k>
  void add_shares() {
    Sums below(static_cast<std::size_t>(complex_.size(k - 1)));
    const auto pieces = local_pieces(complex_, k, static_cast<int>(parts_.size()));
    parallel_blocks(static_cast<Offset>(pieces.size()), 1, [&](Offset number, Offset) {
      const auto p = static_cast<std::size_t>(number);
      const ScatterPiece& piece = pieces[p];
      const auto work = std::make_unique<Work<k>>();
      const auto full = [&] { return work->count == work->capacity; };
      for_each_in_order(
          piece,
          [&](Index first, Index last) {
            while (first < last) {
              const auto count = std::min(static_cast<std::size_t>(last - first), work->capacity - work->count);
              std::iota(work->simplex.data() + work->count, work->simplex.data() + work->count + count, first);
              work->count += count;
              first += static_cast<Index>(count);
              if (full()) treat<k>(p, piece, *work, below.data());
            }
          },
          [&](Index i) {
            work->shared = true;
            work->simplex[work->count++] = i;
            if (full()) treat<k>(p, piece, *work, below.data());
          });
      treat<k>(p, piece, *work, below.data());
    });
    sums_ = std::move(below);
  }

  template <int k>
  void treat(std::size_t p, const ScatterPiece& piece, Work<k>& work, Estimate* below) {
    if (work.count == 0) return;
    poll_cancel();
    metric_.template measure<k>({work.simplex.data(), work.count}, work.metric);
    settle<k>(work);
    parts_[p].centered = parts_[p].centered && are_centered<k>(work);
    if (work.shared) {
      std::array<Estimate, k + 1> unread{};
      give<k, true>(work, piece, below, unread.data());
      keep_home<k>(work, piece);
    } else {
      give<k, false>(work, piece, below, nullptr);
    }
    for (const Index t : work.metric.degenerate)
      if (piece.first <= t && t < piece.last) parts_[p].degenerate.push_back(t);
    if (work.count > 0)
      sink_.template take<k>(
          p, SettledBlock{{work.simplex.data(), work.count}, work.metric.volume.data(), work.dual.data()});
    work.count = 0;
    work.shared = false;
  }

  /// x * unit^power, NaN where that is out of the range of doubles.
  [[nodiscard]] Pack in_range(Pack x, int power) const noexcept {
    Pack result = x;
    for (int i = 0; i < power; ++i) result = result * metric_.unit();
    return select((x == 0) | is_normal(result), result, not_a_number);
  }

  /// The sums of simplices i and j of degree `power` below n that error cannot explain, and error.
  [[nodiscard]] std::pair<Pack, Pack> settled(Index i, Index j) const noexcept {
    const Estimate &a = sums_.data()[i], &b = sums_.data()[j];
    const Pack value(a.value, b.value), error(a.error, b.error);
    return {select(abs(value) <= error, 0, value), error};
  }

  /// Dual volumes, and what a height h is multiplied with to be a share: h value with the error |h| slope + least.
  template <int k>
  void settle(Work<k>& work) const {
    if (work.count % 2 == 1) work.simplex[work.count] = work.simplex[work.count - 1];
    for (std::size_t i = 0; i < work.count; i += 2) {
      Pack value = 1, error = 0, dual = 1;
      if constexpr (k < n) {
        std::tie(value, error) = settled(work.simplex[i], work.simplex[i + 1]);
        dual = in_range(value, n - k);
      } else {
        const Pack h = Pack::load(&work.metric.height[0][i]);
        dual = select(h == h, Pack(1), not_a_number);
      }
      dual.store(&work.dual[i]);
      value = value / (n - k + 1);
      error = error / (n - k + 1);
      const Pack most = abs(value) + error;
      value.store(&work.value[i]);
      (height_error * most + error).store(&work.slope[i]);
      (Pack::load(&work.metric.rounding[i]) * most).store(&work.least[i]);
    }
  }

  /// Shares go to the faces; if some are `shared`, those of other pieces to sums that nobody reads.
  template <int k, bool shared>
  void give(const Work<k>& work, const ScatterPiece& piece, Estimate* below, Estimate* unread) const {
    constexpr std::size_t lead = 16;  // sums are asked for so many simplices before they are needed
    const Index* const table = complex_.face_table(k).data();
    const auto owned = static_cast<std::size_t>(piece.last_face - piece.first_face);
    const auto place = [&](std::size_t i, std::size_t j) {
      const Index face = table[static_cast<std::size_t>(work.simplex[i]) * (k + 1) + j];
      if (!shared) return below + face;
      const bool own = static_cast<std::size_t>(static_cast<Offset>(face) - piece.first_face) < owned;
      const std::array<Estimate*, 2> either{unread + j, below + face};
      return either[own];  // without a branch: it looks random
    };
    for (std::size_t i = 0; i < work.count; ++i) {
      if (i + lead < work.count)
        for (std::size_t j = 0; j <= k; ++j) __builtin_prefetch(place(i + lead, j), 1);
      const Pack factor(work.value[i], work.slope[i]), least(0, work.least[i]);
      for (std::size_t j = 0; j <= k; ++j) {
        const double h = work.metric.height[k - j][i];
        double* const sum = &place(i, j)->value;
        (Pack::load(sum) + (Pack(h, std::abs(h)) * factor + least)).store(sum);
      }
    }
  }

  /// Drops simplices that another piece tells the sink about.
  template <int k>
  static void keep_home(Work<k>& work, const ScatterPiece& piece) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < work.count; ++i) {
      work.simplex[kept] = work.simplex[i];
      work.dual[kept] = work.dual[i];
      work.metric.volume[kept] = work.metric.volume[i];
      kept += piece.first <= work.simplex[i] && work.simplex[i] < piece.last ? 1 : 0;
    }
    work.count = kept;
  }

  template <int k>
  [[nodiscard]] static bool are_centered(const Work<k>& work) {
    bool centered = true;
    for (const auto& row : work.metric.height) {
      auto positive = Pack(0) < Pack(1);
      for (std::size_t i = 0; i + 1 < work.count; i += 2) positive = positive & (Pack::load(&row[i]) > 0);
      centered = centered && positive.all() && row[work.count - 1] > 0;
    }
    return centered;
  }

  void settle_vertices() {
    constexpr auto capacity = static_cast<Index>(MetricBlock<1>::capacity);
    const Offset size = complex_.size(0);
    parallel_blocks(static_cast<Offset>(parts_.size()), 1, [&](Offset number, Offset) {
      const auto parts = static_cast<Offset>(parts_.size());
      const auto last = static_cast<Index>(size * (number + 1) / parts);
      std::array<double, capacity> ones{}, dual{};
      std::array<Index, capacity> vertex{};
      ones.fill(1);
      for (auto begin = static_cast<Index>(size * number / parts); begin < last; begin += capacity) {
        const auto count = static_cast<std::size_t>(std::min(capacity, last - begin));
        std::iota(vertex.begin(), vertex.end(), begin);
        for (std::size_t i = 0; i < count; i += 2)
          if constexpr (n > 0)
            in_range(settled(vertex[i], vertex[std::min(i + 1, count - 1)]).first, n).store(&dual[i]);
          else
            Pack(1).store(&dual[i]);
        sink_.template take<0>(static_cast<std::size_t>(number),
                               SettledBlock{{vertex.data(), count}, ones.data(), dual.data()});
      }
    });
  }

  const SimplicialComplex<n>& complex_;
  BlockMetric<n> metric_;
  Sink& sink_;
  std::vector<Part> parts_;
  Sums sums_;  // dual volumes, in units, of the degree that is treated next
};

}  // namespace derham::detail
