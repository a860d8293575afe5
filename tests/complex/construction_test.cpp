// The library's complex against the reference's, bit for bit, on random input.
#include "derham/complex/construction.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "support/compare_with_reference.hpp"
#include "support/random_rows.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string_view>
#include <type_traits>
#include <vector>

namespace derham {
namespace {

using support::expect_same_as_reference;
using support::Random;
using support::Rows;

template <class Dimension>
class Construction : public testing::Test {
 protected:
  static constexpr int n = Dimension::value;

  /// Calls `rows(random)` for the seeds 0 … count-1 and compares; stops at the first seed that fails.
  template <class MakeRows>
  static void compare(int count, MakeRows&& make_rows) {
    for (int seed = 0; seed < count && !testing::Test::HasFailure(); ++seed) {
      SCOPED_TRACE(testing::Message() << "n = " << n << ", seed " << seed);
      Random random(static_cast<Random::result_type>(seed));
      expect_same_as_reference<n>(make_rows(random));
    }
  }
};

template <int n>
using Dimension = std::integral_constant<int, n>;
using Dimensions =
    testing::Types<Dimension<0>, Dimension<1>, Dimension<2>, Dimension<3>, Dimension<4>, Dimension<5>, Dimension<6>>;
TYPED_TEST_SUITE(Construction, Dimensions);

TYPED_TEST(Construction, OneSimplex) {
  constexpr int dimension = TypeParam::value;
  this->compare(
      5, [](Random& random) { return support::shuffled({support::subset(dimension + 1, 0, 9, random)}, random); });
}

TYPED_TEST(Construction, RandomFacets) {
  this->compare(60, [](Random& random) { return support::random_pure(TypeParam::value, random); });
}

TYPED_TEST(Construction, SeveralComponents) {
  this->compare(10, [](Random& random) { return support::random_components(TypeParam::value, 3, random); });
}

TYPED_TEST(Construction, ManySimplicesOnManyVertices) {
  constexpr int dimension = TypeParam::value;
  this->compare(3, [](Random& random) {
    Rows rows;
    for (int i = 0; i < 300; ++i) rows.push_back(support::subset(dimension + 1, 0, 100, random));
    return support::shuffled(rows, random);
  });
}

TYPED_TEST(Construction, MixedDimensions) {
  if constexpr (TypeParam::value >= 1) {
    this->compare(60, [](Random& random) { return support::random_mixed(TypeParam::value, random); });
    this->compare(10, [](Random& random) { return support::random_rips(TypeParam::value, random); });
  }
}

// For n = 2, 3 the local links are bit matrices of side 8, 16 and 64 for stars of up to 250 vertices; else of 64-bit words
// up to 512 neighbours, and sorted lists beyond.
TYPED_TEST(Construction, HubsAtTheSeamsOfTheBitMatrix) {
  if constexpr (TypeParam::value >= 2) {
    for (const int upper : {7, 8, 9, 15, 16, 17, 31, 40, 50, 60, 63, 64, 65, 80, 120, 128, 129, 511, 512, 513, 600}) {
      if (TypeParam::value >= 5 && upper > 17 && upper % 64 > 1) continue;
      this->compare(1, [&](Random& random) { return support::hub(TypeParam::value, upper, random); });
    }
  }
}

// One top simplex after the other at the same vertex: the orders and the stars at their seams.
TYPED_TEST(Construction, StarsOfEverySize) {
  if constexpr (TypeParam::value == 2 || TypeParam::value == 3) {
    for (const int size : {1, 2, 8, 9, 16, 17, 32, 33, 62, 63, 64, 83, 84, 85, 125, 126, 127, 128}) {
      this->compare(1, [&](Random& random) {
        Rows rows;
        for (Index i = 0; i < size; ++i) {
          Rows::value_type row{0, 1 + i, 2 + i};
          if (TypeParam::value == 3) row.push_back(3 + i);
          rows.push_back(row);
        }
        return support::reordered(rows, random);
      });
    }
  }
}

// The edge from vertex 1 to each of many is looked for: the first few one after the other, the others by halving.
TYPED_TEST(Construction, ManyTetsAroundOneEdge) {
  if constexpr (TypeParam::value == 3) {
    for (const Index size : {3, 8, 9, 62, 63, 64, 65, 66, 67, 72, 73, 129, 600}) {
      this->compare(1, [&](Random& random) {
        Rows rows;
        for (Index i = 0; i < size; ++i) rows.push_back({0, 1, 2 + i, 2 + (i + 1) % size});
        return support::reordered(rows, random);
      });
    }
  }
}

TYPED_TEST(Construction, SeveralBlocksOfVertices) {
  constexpr int dimension = TypeParam::value;
  if constexpr (dimension >= 1 && dimension <= 3) {
    this->compare(2, [](Random& random) {
      Rows rows;
      for (int i = 0; i < 8000; ++i) {  // some near each other, some anywhere
        const int low = i % 2 == 0 ? 0 : support::uniform(random, 0, 4980);
        rows.push_back(support::subset(dimension + 1, low, i % 2 == 0 ? 5000 : low + 20, random));
      }
      return support::shuffled(rows, random);
    });
  }
}

// So many that the simplices of a block of vertices stand far from each other.
TYPED_TEST(Construction, RowsInNoOrder) {
  constexpr int dimension = TypeParam::value;
  if constexpr (dimension == 2 || dimension == 3) {
    this->compare(1, [](Random& random) {
      Rows rows;
      for (int i = 0; i < 25000; ++i) {
        const int low = i / 2;
        rows.push_back(support::subset(dimension + 1, low, low + 8, random));
      }
      return support::shuffled(rows, random);
    });
  }
}

TYPED_TEST(Construction, EmptyInput) {
  constexpr int dimension = TypeParam::value;
  const SimplicialComplex<dimension> from_rows{SimplexList()}, by_default;
  for (const auto* K : {&from_rows, &by_default}) {
    for (int k = -1; k <= dimension + 1; ++k) EXPECT_EQ(K->size(k), 0);
    EXPECT_TRUE(K->is_pure());
    EXPECT_TRUE(K->is_orientable());
    EXPECT_EQ(facet_components(*K).count, 0);
    EXPECT_EQ(K->component_count(), 0);
    EXPECT_EQ(K->euler_characteristic(), 0);
    EXPECT_FALSE(K->find({0}));
    EXPECT_EQ(incidence(*K, dimension, 0).rows(), 0);
  }
}

TEST(AccumulateCounts, GivesEndsAndRefusesListsThatDoNotFitTheIndex) {
  std::vector<Index> counts{0, 3, 0, 4};
  EXPECT_EQ(accumulate_counts(counts, 1), 7);
  EXPECT_EQ(counts, (std::vector<Index>{0, 3, 3, 7}));
  EXPECT_EQ(accumulate_counts({}, 1), 0);
  counts = {0, 3, 0, 4};
  EXPECT_EQ(accumulate_counts(counts, 1, 7), 7);
  counts = {0, 3, 0, 4};
  EXPECT_THROW((void)accumulate_counts(counts, 1, 6), LimitError);
  constexpr Index largest = std::numeric_limits<Index>::max();
  counts = {0, largest - 1, 1};
  EXPECT_EQ(accumulate_counts(counts, 2), largest);
  counts = {0, largest, 1};
  try {
    (void)accumulate_counts(counts, 2);
    FAIL() << "no error";
  } catch (const LimitError& error) {
    EXPECT_NE(std::string_view(error.what()).find("simplices of degree 2"), std::string_view::npos) << error.what();
  }
}

TEST(MixedConstruction, FacesAmongTheRowsAreAbsorbed) {
  const SimplicialComplex<2> K(SimplexList{{2, 3}, {0, 2, 1}, {1, 0}, {4}, {2}});
  EXPECT_EQ(K.size(0), 5);
  EXPECT_EQ(K.size(1), 4);
  EXPECT_EQ(K.size(2), 1);
  EXPECT_FALSE(K.is_pure());
  ASSERT_EQ(K.maximal_lower().size(), 2u);  // vertex 4 and edge (2,3)
  EXPECT_EQ(K.maximal_lower()[0].degree, 0);
  EXPECT_EQ(K.maximal_lower()[0].index, 4);
  EXPECT_EQ(K.maximal_lower()[1].degree, 1);
  EXPECT_EQ(K.maximal_lower()[1].index, K.at({2, 3}).index);
  EXPECT_EQ(K.row_target(2).index, K.at({0, 1}).index);
  EXPECT_EQ(K.sign(2, 0), -1);  // the first input tuple is odd and positive
  EXPECT_EQ(K.component_count(), 2);
  EXPECT_EQ(K.euler_characteristic(), 2);
  EXPECT_TRUE(SimplicialComplex<2>(SimplexList{{0, 1, 2}, {1, 2}}).is_pure());
}

}  // namespace
}  // namespace derham
