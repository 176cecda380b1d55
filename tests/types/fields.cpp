// Compiled with one EXPRESSION after the other (CMakeLists.txt), of functions or ON_PATCHES; nothing runs.
#include "operators/algebra/algebra.h"
#ifdef ON_PATCHES
#include "operators/fields/matrix/reflection_matrix.h"
#include "operators/fields/matrix/transport_matrix.h"
#else
#include "operators/pointwise/reflection.h"
#include "operators/pointwise/transport.h"
#endif

namespace neumann {

#ifdef ON_PATCHES
using Transport = TransportMatrix<4>;
using Reflection = ReflectionMatrix<4>;
#else
using Transport = TransportOperator;
using Reflection = ReflectionOperator;
#endif

// L leaves surfaces, Li arrives there.
void write(const Transport& T, const Reflection& R, const Transport::Domain& L, const Reflection::Domain& Li) {
    [[maybe_unused]] const Identity<Transport::Domain> I;
    [[maybe_unused]] const auto& fields = std::pair(L, Li);
    [[maybe_unused]] const auto& operators = std::pair(T, R);
    (void)(EXPRESSION);
}

}  // namespace neumann
