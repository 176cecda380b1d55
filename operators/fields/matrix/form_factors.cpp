#include "operators/fields/matrix/form_factors.h"

#include <boost/math/special_functions/legendre.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace neumann {

namespace {

// ---- far pairs ----

constexpr int most_points = 10;

struct GaussRule {
    std::vector<double> point, weight;  // on [0, 1]
};

const GaussRule& gauss(int n) {
    static const std::vector<GaussRule> rules = [] {
        std::vector<GaussRule> all(most_points + 1);
        for (int n = 1; n <= most_points; ++n) {
            for (const double x : boost::math::legendre_p_zeros<double>(n)) {
                const double slope = boost::math::legendre_p_prime(n, x), w = 1.0 / ((1.0 - x * x) * slope * slope);
                for (const double s : {x, -x}) {
                    all[n].point.push_back(0.5 * (1.0 + s));
                    all[n].weight.push_back(w);
                    if (x == 0.0) break;
                }
            }
        }
        return all;
    }();
    return rules[n];
}

// The number of Gauss points per dimension for full double precision, from the ellipse in which the integrand is analytic.
int points_needed(const Parallelogram& a, const Parallelogram& b) {
    const auto reach = [](const Parallelogram& p) { return 0.5 * std::max(glm::length(p.u + p.v), glm::length(p.u - p.v)); };
    const auto half_edge = [](const Parallelogram& p) { return 0.5 * std::max(glm::length(p.u), glm::length(p.v)); };
    const double distance = glm::length(a.centre() - b.centre());
    const double z = std::min((distance - reach(b)) / half_edge(a), (distance - reach(a)) / half_edge(b));
    if (!(z > 1.5)) return most_points + 1;
    return std::max(2, static_cast<int>(std::ceil(18.5 / std::log(z + std::sqrt(z * z - 1.0)))));
}

double by_quadrature(const Parallelogram& a, const Parallelogram& b, int n) {
    const GaussRule& rule = gauss(n);
    const Vec3 na = a.normal(), nb = b.normal();
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec3 p = a.corner + rule.point[i] * a.u + rule.point[j] * a.v;
            double inner = 0.0;
            for (int k = 0; k < n; ++k)
                for (int l = 0; l < n; ++l) {
                    const Vec3 d = b.corner + rule.point[k] * b.u + rule.point[l] * b.v - p;
                    const double r2 = glm::dot(d, d);
                    inner -= rule.weight[k] * rule.weight[l] * glm::dot(na, d) * glm::dot(nb, d) / (r2 * r2);
                }
            sum += rule.weight[i] * rule.weight[j] * inner;
        }
    return sum * a.area() * b.area() / std::numbers::pi;
}

// ---- near pairs ----

using Real = long double;

struct Interval {
    double low, high;
    double operator[](int i) const { return i == 0 ? low : high; }
};

bool along(const Vec3& v, const Vec3& axis) { return glm::length(glm::cross(v, axis)) <= 1e-12 * glm::length(v); }

// The range of coordinates (p − origin) · axis over a patch.
Interval range(const Parallelogram& p, const Vec3& origin, const Vec3& axis) {
    const double start = glm::dot(p.corner - origin, axis), end = start + glm::dot(p.u + p.v, axis);
    return {std::min(start, end), std::max(start, end)};
}

// Two rectangles in the coordinates of their closed form.
struct Pair {
    bool parallel;
    Interval ax, ay, bx,
        by;    // parallel: both in the plane; perpendicular: distance from the other's plane, and along the common line
    double z;  // parallel: distance of the planes
};

std::optional<Pair> rectangles(const Parallelogram& a, const Parallelogram& b) {
    const Vec3 na = a.normal(), nb = b.normal();
    const auto rectangle = [](const Parallelogram& p) {
        return std::abs(glm::dot(p.u, p.v)) <= 1e-12 * glm::length(p.u) * glm::length(p.v);
    };
    if (!rectangle(a) || !rectangle(b)) return std::nullopt;
    if (along(na, nb)) {
        const Vec3 x = glm::normalize(a.u), y = glm::normalize(a.v);
        if (!along(b.u, x) && !along(b.u, y)) return std::nullopt;
        return Pair{true,
                    range(a, a.corner, x),
                    range(a, a.corner, y),
                    range(b, a.corner, x),
                    range(b, a.corner, y),
                    std::abs(glm::dot(b.corner - a.corner, na))};
    }
    if (std::abs(glm::dot(na, nb)) > 1e-12) return std::nullopt;
    const Vec3 line = glm::normalize(glm::cross(na, nb));
    for (const Parallelogram* p : {&a, &b})
        if (!along(p->u, line) && !along(p->v, line)) return std::nullopt;
    return Pair{false, range(a, b.corner, nb), range(a, a.corner, line), range(b, a.corner, na), range(b, a.corner, line), 0.0};
}

// factor · ln(square), or 0 if square is 0.
Real log_term(Real factor, Real square) { return square > 0 ? factor * std::log(square) : 0; }

Real parallel_corner(Real x, Real y, Real z) {
    const Real rx = std::hypot(x, z), ry = std::hypot(y, z);
    return y * rx * std::atan2(y, rx) + x * ry * std::atan2(x, ry) - log_term(z * z / 2, x * x + y * y + z * z);
}

Real perpendicular_corner(Real x, Real xi, Real y) {
    const Real s2 = x * x + xi * xi, s = std::sqrt(s2);
    return y * s * std::atan2(y, s) - log_term((s2 - y * y) / 4, s2 + y * y);
}

double in_closed_form(const Pair& pair) {
    Real sum = 0;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            for (int k = 0; k < 2; ++k)
                for (int l = 0; l < 2; ++l) {
                    const Real y = Real(pair.ay[j]) - Real(pair.by[l]);
                    const Real corner = pair.parallel ? parallel_corner(Real(pair.ax[i]) - Real(pair.bx[k]), y, pair.z)
                                                      : perpendicular_corner(pair.ax[i], pair.bx[k], y);
                    sum += (i + j + k + l) % 2 == 0 ? corner : -corner;
                }
    return static_cast<double>(sum / (2 * std::numbers::pi_v<Real>));
}

// ---- which is which ----

// Whether b has points in front of a's plane. Throws if it has some on both sides.
bool in_front(const Parallelogram& a, const Parallelogram& b) {
    const Vec3 n = a.normal();
    const double tolerance = 1e-12 * (glm::length(b.corner - a.corner) + glm::length(b.u) + glm::length(b.v));
    double lowest = 0.0, highest = 0.0;
    for (const Vec3& p : {b.corner, b.corner + b.u, b.corner + b.v, b.corner + b.u + b.v}) {
        const double height = glm::dot(p - a.corner, n);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    if (lowest < -tolerance && highest > tolerance) throw std::invalid_argument("a patch crosses the plane of another");
    return highest > tolerance;
}

double integrate(const Parallelogram& a, const Parallelogram& b, const std::optional<Pair>& pair) {
    const int points = points_needed(a, b);
    if (points <= most_points) return by_quadrature(a, b, points);
    if (!pair) throw std::invalid_argument("near patches have a closed form only if they are parallel or perpendicular rectangles");
    return in_closed_form(*pair);
}

bool see_each_other(const Parallelogram& a, const Parallelogram& b) {
    if (!(a.area() > 0.0 && b.area() > 0.0)) throw std::invalid_argument("a patch has no area");
    return in_front(a, b) && in_front(b, a);
}

}  // namespace

std::vector<Parallelogram> cells(const Parallelogram& face, int nu, int nv) {
    std::vector<Parallelogram> all;
    const Vec3 u = face.u / static_cast<double>(nu), v = face.v / static_cast<double>(nv);
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) all.push_back({face.corner + double(i) * u + double(j) * v, u, v});
    return all;
}

double exchange_area(const Parallelogram& a, const Parallelogram& b) {
    return see_each_other(a, b) ? integrate(a, b, rectangles(a, b)) : 0.0;
}

double ExchangeAreas::operator()(const Parallelogram& a, const Parallelogram& b) {
    if (!see_each_other(a, b)) return 0.0;
    const std::optional<Pair> pair = rectangles(a, b);
    if (!pair) return integrate(a, b, pair);
    if (unit_ == 0.0) unit_ = std::ldexp(std::sqrt(a.area()), -40);
    const auto key = [&](double length) { return std::llround(length / unit_); };
    // The sign of an offset along a common direction does not matter.
    const auto offset = [&](const Interval& p, const Interval& q) { return std::llabs(key(p.low + p.high - q.low - q.high)); };
    const auto size = [&](const Interval& p) { return key(p.high - p.low); };
    std::array<long long, 8> kind;
    if (pair->parallel)
        kind = {0,
                size(pair->ax),
                size(pair->ay),
                size(pair->bx),
                size(pair->by),
                offset(pair->ax, pair->bx),
                offset(pair->ay, pair->by),
                key(pair->z)};
    else
        kind = {1,
                key(pair->ax.low),
                key(pair->ax.high),
                key(pair->bx.low),
                key(pair->bx.high),
                size(pair->ay),
                size(pair->by),
                offset(pair->ay, pair->by)};
    const auto found = known_.find(kind);
    return found != known_.end() ? found->second : known_.emplace(kind, integrate(a, b, pair)).first->second;
}

FormFactors form_factors(const std::vector<Parallelogram>& patches) {
    const auto n = static_cast<Eigen::Index>(patches.size());
    FormFactors result{DenseChannel::Matrix::Zero(n, n), Vector(n)};
    for (Eigen::Index a = 0; a < n; ++a) result.area[a] = patches[a].area();
    ExchangeAreas exchange;
    for (Eigen::Index a = 0; a < n; ++a)
        for (Eigen::Index b = 0; b < a; ++b) {
            const double area = exchange(patches[a], patches[b]);
            result.F(a, b) = area / result.area[a];
            result.F(b, a) = area / result.area[b];
        }
    return result;
}

}  // namespace neumann
