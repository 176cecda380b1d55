// L = Le + K L with the operators as functions: in a furnace of albedo a, bounce i is a^i wherever one looks.
#include "core/reader/read_scene.h"
#include "operators/algebra/neumann_series.h"
#include "operators/pointwise/emission.h"
#include "operators/pointwise/reflection.h"
#include "operators/pointwise/transport.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

namespace {

class Numbers : public neumann::Random {
public:
    double next() override { return uniform_(engine_); }

private:
    std::mt19937_64 engine_{1};
    std::uniform_real_distribution<double> uniform_;
};

}  // namespace

int main(int argc, char** argv) try {
    constexpr double albedo = 0.7, epsilon = std::numeric_limits<double>::epsilon();
    const neumann::Scene scene = neumann::read_scene(argc > 1 ? argv[1] : "", {{"albedo", "0.7"}});
    const neumann::Vec3 view = glm::normalize(neumann::Vec3(1.0, 2.0, -3.0));
    neumann::SurfacePoint p;
    if (!scene.geometry.first_hit({0.1, 0.2, 0.3}, view, std::numeric_limits<double>::infinity(), p)) return 1;

    Numbers numbers;
    const neumann::TransportOperator T(scene.geometry);
    const neumann::ReflectionOperator R(scene.materials);
    neumann::NeumannSeries L(R * T, neumann::emission(scene.emitters));
    for (; L.bounce() <= 6; L.advance()) {
        const double radiance = L.term()(p, -view, numbers).g;
        std::printf("bounce %d: %.6f\n", L.bounce(), radiance);
        if (std::abs(radiance / std::pow(albedo, L.bounce()) - 1.0) > 8.0 * (L.bounce() + 1) * epsilon) return 1;
    }
} catch (const neumann::InputError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
}
