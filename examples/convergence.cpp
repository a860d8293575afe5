// Prints how fast errors fall when meshes get finer: docs/operators/convergence.md explains the tables.
#include "convergence_studies.hpp"

#include <cmath>
#include <cstdio>
#include <initializer_list>

using namespace derham;
using namespace derham::studies;

namespace {

/// An error and its order, the logarithm of its quotient by that on cells half as long; none in the first row.
void print_error(double error, double last) {
  if (last > 0)
    std::printf("  %.2e %5.2f", error, std::log2(last / error));
  else
    std::printf("  %.2e     -", error);
}

template <int n>
void print_poisson(std::initializer_list<Index> sizes) {
  const char* const families[] = {"cut cubes", "Delaunay"};
  const char* const stars[] = {"circumcentric", "Whitney", "barycentric"};
  std::printf("\nn = %d      star           cells   u in L2 order     u max order  du in L2 order\n", n);
  for (const Family family : {Family::cut_cubes, Family::delaunay})
    for (const Star star : {Star::circumcentric, Star::whitney, Star::barycentric}) {
      if (family == Family::delaunay && star == Star::barycentric) continue;
      PoissonErrors last{};
      for (const Index cells : sizes) {
        const PoissonErrors now = poisson<n>(family, star, cells);
        std::printf("%-9s  %-13s  %5d", families[static_cast<int>(family)], stars[static_cast<int>(star)],
                    static_cast<int>(cells));
        print_error(now.l2, last.l2);
        print_error(now.max, last.max);
        print_error(now.grad, last.grad);
        std::printf("\n");
        last = now;
      }
    }
}

template <int n, int k = 0>
void print_interpolation(std::initializer_list<Index> sizes) {
  std::printf("%d  %d", n, k);
  double last = 0;
  for (const Index cells : sizes) {
    const double now = interpolation<n, k>(cells);
    std::printf("  %5d", static_cast<int>(cells));
    print_error(now, last);
    last = now;
  }
  std::printf("\n");
  if constexpr (k < n) print_interpolation<n, k + 1>(sizes);
}

template <int n, int k = 0>
void print_transport(std::initializer_list<Index> sizes) {
  double last = 0;
  for (const Index cells : sizes) {
    const Transport now = transport<n, k>(cells);
    std::printf("%d  %d  %5d   %.2e  %5d", n, k, static_cast<int>(cells), now.cfl_bound, now.steps);
    print_error(now.error, last);
    if (k == n) std::printf("  %s", now.lost < 1e-13 ? "kept" : "lost");
    std::printf("\n");
    last = now.error;
  }
  if constexpr (k < n) print_transport<n, k + 1>(sizes);
}

}  // namespace

int main() {
  std::printf("Poisson's equation\n");
  print_poisson<2>({8, 16, 32, 64});
  print_poisson<3>({4, 8, 16});

  std::printf("\nInterpolation\n\nn  k");
  for (int column = 0; column < 3; ++column) std::printf("  cells     in L2 order");
  std::printf("\n");
  print_interpolation<1>({16, 32, 64});
  print_interpolation<2>({8, 16, 32});
  print_interpolation<3>({4, 8, 16});

  std::printf("\nTransport\n\nn  k  cells  CFL bound  steps     in L2 order  integral\n");
  print_transport<1>({16, 32, 64});
  print_transport<2>({8, 16, 32});
  print_transport<3>({4, 8});
}
