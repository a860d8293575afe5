#include "derham/io/matrix_market.hpp"

#include "io/io_fixture.hpp"

#include <limits>
#include <vector>

namespace derham::io_test {
namespace {

TEST(MatrixMarket, WritesCompressedRowsFromOne) {
  const TemporaryDirectory directory;
  const std::vector<Offset> offsets{0, 2, 2, 3};
  const std::vector<Index> columns{0, 3, 1};
  const std::vector<std::int8_t> values{-1, 1, 1};
  write_matrix_market(directory / "d0.mtx", 3, 4, offsets, columns, values);
  EXPECT_EQ(read_bytes(directory / "d0.mtx"),
            "%%MatrixMarket matrix coordinate integer general\n3 4 3\n1 1 -1\n1 4 1\n3 2 1\n");
}

TEST(MatrixMarket, WritesEmptyMatrices) {
  const TemporaryDirectory directory;
  write_matrix_market(directory / "d.mtx", 0, 5, std::vector<Offset>{0}, {}, {});
  EXPECT_EQ(read_bytes(directory / "d.mtx"), "%%MatrixMarket matrix coordinate integer general\n0 5 0\n");
  write_matrix_market(directory / "s.mtx", {});
  EXPECT_EQ(read_bytes(directory / "s.mtx"), "%%MatrixMarket matrix array real general\n0 1\n");
}

TEST(MatrixMarket, WritesVectorsToTheLastBit) {
  const TemporaryDirectory directory;
  write_matrix_market(directory / "star.mtx", std::vector<double>{0.1, -2, 1.0 / 3});
  EXPECT_EQ(read_bytes(directory / "star.mtx"),
            "%%MatrixMarket matrix array real general\n3 1\n0.1\n-2\n0.3333333333333333\n");
}

TEST(MatrixMarket, RefusesWhatDoesNotFit) {
  const TemporaryDirectory directory;
  const auto path = directory / "x.mtx";
  const std::vector<Index> columns{0, 1};
  const std::vector<std::int8_t> values{1, 1};
  EXPECT_THROW(write_matrix_market(path, 2, 2, std::vector<Offset>{0, 2}, columns, values), InputError);
  EXPECT_THROW(write_matrix_market(path, 2, 2, std::vector<Offset>{0, 1, 3}, columns, values), InputError);
  EXPECT_THROW(write_matrix_market(path, 2, 2, std::vector<Offset>{0, 3, 2}, columns, values), InputError);
  EXPECT_THROW(write_matrix_market(path, 2, 1, std::vector<Offset>{0, 1, 2}, columns, values), InputError);
  EXPECT_THROW(write_matrix_market(path, 2, 2, std::vector<Offset>{0, 1, 2}, columns, std::vector<std::int8_t>{1}),
               InputError);
  EXPECT_THROW(write_matrix_market(path, 0, 2, {}, {}, {}), InputError);
  EXPECT_THROW(write_matrix_market(path, std::vector<double>{1, std::numeric_limits<double>::quiet_NaN()}), InputError);
  EXPECT_EQ(directory.file_count(), 0);
}

}  // namespace
}  // namespace derham::io_test
