// The wave equation p_t = -div v, v_t = -grad p on a square with walls, by leapfrog. The two steps are written as in the
// formulas; which ⋆ and d are meant follows from the types.
#include <derham/geometry/volumes.hpp>
#include <derham/hodge/hodge_star.hpp>
#include <derham/meshes/boxes.hpp>
#include <derham/operators/expression.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

using namespace derham;

using Pressure = PrimalForm<2, 0>;
using Velocity = PrimalForm<2, 1>;

int main() {
  const MeshData mesh = meshes::box(2, 32);
  SimplicialComplex<2> K(mesh.simplices);
  const auto geometry = Geometry<2>::from_mesh(K, mesh);
  orient_by_volume(K, geometry);
  const HodgeStar<2> star(K, geometry);
  const Derivative<2> d(K);
  constexpr double dt = 0.01;

  const Operator<Pressure, Velocity> velocity_step = -dt * d;
  const Operator<Velocity, Pressure> pressure_step = -dt * star * d * star;
  const auto step = [&](Pressure& p, Velocity& v) { p += pressure_step(v += velocity_step(p)); };

  // A standing wave cos(πx) cos(πt): the velocity lives half a step before the pressure.
  Pressure p(K);
  for (Index i = 0; i < p.size(); ++i) p[i] = std::cos(std::numbers::pi * mesh.points[static_cast<std::size_t>(2 * i)]);
  Velocity v = -0.5 * velocity_step(p);

  std::printf("time  pressure in the corner  cos(pi t)\n");
  for (int n = 0; n <= 200; ++n) {
    if (n % 40 == 0) std::printf("%4.2f  %22.3f  %9.3f\n", n * dt, p[0], std::cos(std::numbers::pi * n * dt));
    step(p, v);
  }
}
