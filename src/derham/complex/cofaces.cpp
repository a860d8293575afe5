#include "derham/complex/cofaces.hpp"

#include "derham/complex/transposed_table.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

namespace derham {

template <int n>
Cofaces::Cofaces(const SimplicialComplex<n>& K, int k) : degree_(k) {
  if (k < 0 || k >= n)
    throw InputError(text("cofaces of degree ", k, " in a complex of dimension ", n, "; degrees are 0 to ", n - 1));
  const auto faces = K.face_table(k + 1);
  const auto width = static_cast<std::size_t>(k) + 2;
  detail::require_cofaces_fit(static_cast<Offset>(faces.size()), k);
  offsets_ = BulkArray<Index>(static_cast<std::size_t>(K.size(k)) + 1);
  packed_ = BulkArray<Index>(faces.size());
  detail::transpose_table<Index>(faces, width, offsets_, packed_, [width](Index coface, std::size_t position) {
    return face_sign(static_cast<int>(width - 1 - position)) > 0 ? coface : ~coface;
  });
}

void detail::require_cofaces_fit(Offset entries, int k, Offset limit) {
  if (entries > limit)
    throw LimitError(text("there are ", entries, " cofaces of simplices of degree ", k, ", more than ", limit,
                          " and than the index type counts; build derham with DERHAM_INDEX64=ON"));
}

template Cofaces::Cofaces(const SimplicialComplex<0>&, int);
template Cofaces::Cofaces(const SimplicialComplex<1>&, int);
template Cofaces::Cofaces(const SimplicialComplex<2>&, int);
template Cofaces::Cofaces(const SimplicialComplex<3>&, int);
template Cofaces::Cofaces(const SimplicialComplex<4>&, int);
template Cofaces::Cofaces(const SimplicialComplex<5>&, int);
template Cofaces::Cofaces(const SimplicialComplex<6>&, int);

}  // namespace derham
