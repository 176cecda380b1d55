#include "core/emitter/environment_map.h"

#include "core/image/display.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// The t in [0, 1] up to which the integral of the straight line from a to b is the fraction u of the whole.
double invert_line(double a, double b, double u) {
    const double root = std::sqrt(a * a + u * (b * b - a * a));
    return a + root > 0.0 ? std::min(u * (a + b) / (a + root), 1.0) : u;
}

double mix(double a, double b, double t) { return (1.0 - t) * a + t * b; }

}  // namespace

// Y s between two rows: a polynomial with these Bernstein coefficients, which are not negative.
struct EnvironmentMap::Quadratic {
    double b0, b1, b2;

    double operator()(double t) const {
        const double r = 1.0 - t;
        return b0 * r * r + 2.0 * b1 * r * t + b2 * t * t;
    }
    double integral() const { return (b0 + b1 + b2) / 3.0; }
    double integral(double t) const {
        const double r = 1.0 - t;
        return t * (b0 * r * r + (b0 + b1) * r * t + integral() * t * t);
    }
    // The position up to which the integral is the fraction u of the whole: Newton's method with bisection.
    double invert(double u) const {
        const double target = u * integral();
        double low = 0.0, high = 1.0, t = 0.5;
        for (int i = 0; i < 60; ++i) {
            const double difference = integral(t) - target;
            (difference > 0.0 ? high : low) = t;
            double next = t - difference / (*this)(t);
            if (!(next > low && next < high)) next = 0.5 * (low + high);
            if (std::abs(next - t) < 1e-14) return next;
            t = next;
        }
        return t;
    }
};

double EnvironmentMap::Tables::along(int y, int x) const {
    return along_row[static_cast<std::size_t>(y) * (static_cast<std::size_t>(image.width) + 1) + static_cast<std::size_t>(x)];
}
double EnvironmentMap::Tables::along(const TexelPosition& p, int x) const { return mix(along(p.y, x), along(p.y + 1, x), p.down); }
EnvironmentMap::Quadratic EnvironmentMap::Tables::between_rows(int y) const {
    const double above = along(y, image.width), below = along(y + 1, image.width);
    const double s0 = sine[static_cast<std::size_t>(y)], s1 = sine[static_cast<std::size_t>(y) + 1];
    return {above * s0, 0.5 * (above * s1 + below * s0), below * s1};
}

EnvironmentMap::EnvironmentMap(Image image, double scale, const Mat4& to_world)
    : x_(to_world[0]), y_(glm::normalize(Vec3(to_world[1]))), scale_(scale) {
    x_ = glm::normalize(x_ - y_ * glm::dot(y_, x_));
    z_ = glm::cross(x_, y_);
    if (glm::dot(z_, Vec3(to_world[2])) < 0.0) z_ = -z_;

    Tables tables;
    const int width = image.width, height = image.height;
    for (const Rgb& c : image.pixels) {
        largest_ = glm::max(largest_, c * scale);
        is_grey_ = is_grey_ && neumann::is_grey(c);
    }
    for (int y = 0; y < height; ++y) {
        tables.sine.push_back(y == 0 || y == height - 1 ? 0.0 : std::sin(pi * y / (height - 1)));
        double sum = 0.0;
        for (int x = 0; x < width; ++x) {
            tables.along_row.push_back(sum);
            sum += 0.5 * (luminance(image.at(x, y)) + luminance(image.at((x + 1) % width, y)));
        }
        tables.along_row.push_back(sum);
    }
    tables.image = std::move(image);
    double sum = 0.0;
    for (int y = 0; y < height; ++y) {
        tables.up_to_row.push_back(sum);
        if (y + 1 < height) sum += tables.between_rows(y).integral();
    }
    total_ = sum * (pi / (height - 1)) * (2.0 * pi / width);
    if (sum > 0.0)
        for (double& part : tables.up_to_row) part /= sum;
    tables_ = std::make_shared<const Tables>(std::move(tables));
}

EnvironmentMap::TexelPosition EnvironmentMap::place(const Vec3& local) const {
    const int width = tables_->image.width, height = tables_->image.height;
    const double longitude = std::atan2(local.x, -local.z) * (0.5 * inv_pi) * width - 0.5;
    const double latitude = std::atan2(std::hypot(local.x, local.z), local.y) * inv_pi * (height - 1);
    const double column = std::floor(longitude);
    const int y = std::min(static_cast<int>(latitude), height - 2);
    return {(static_cast<int>(column) + width) % width, y, longitude - column, latitude - y};
}

Rgb EnvironmentMap::unscaled(const TexelPosition& p) const {
    const Image& image = tables_->image;
    const int next = p.x + 1 == image.width ? 0 : p.x + 1;
    const Rgb above = glm::mix(image.at(p.x, p.y), image.at(next, p.y), p.right),
              below = glm::mix(image.at(p.x, p.y + 1), image.at(next, p.y + 1), p.right);
    return glm::mix(above, below, p.down);
}

Rgb EnvironmentMap::radiance(const Vec3& w) const {
    return unscaled(place({glm::dot(x_, w), glm::dot(y_, w), glm::dot(z_, w)})) * scale_;
}

Vec3 EnvironmentMap::sample(const Vec2& u) const {
    const Tables& t = *tables_;
    const int width = t.image.width, height = t.image.height;
    const auto below = std::upper_bound(t.up_to_row.begin() + 1, t.up_to_row.end() - 1, u.y);
    TexelPosition p{0, static_cast<int>(below - t.up_to_row.begin()) - 1, 0.0, 0.0};
    p.down = t.between_rows(p.y).invert((u.y - below[-1]) / (below[0] - below[-1]));

    const double target = u.x * t.along(p, width);
    for (int beyond = width; beyond - p.x > 1;) {
        const int middle = (p.x + beyond) / 2;
        (t.along(p, middle) > target ? beyond : p.x) = middle;
    }
    const double left = t.along(p, p.x), part = (target - left) / (t.along(p, p.x + 1) - left);
    p.right = invert_line(luminance(unscaled({p.x, p.y, 0.0, p.down})), luminance(unscaled({p.x, p.y, 1.0, p.down})), part);

    const double turn = (p.x + 0.5 + p.right) / width;
    const Vec2 phi = direction_on_circle(turn < 1.0 ? turn : turn - 1.0);
    const Vec2 theta = direction_on_circle(0.5 * (p.y + p.down) / (height - 1));
    return x_ * (theta.y * phi.y) + y_ * theta.x - z_ * (theta.y * phi.x);
}

double EnvironmentMap::pdf(const Vec3& w) const {
    const Vec3 local(glm::dot(x_, w), glm::dot(y_, w), glm::dot(z_, w));
    const TexelPosition p = place(local);
    const std::vector<double>& sine = tables_->sine;
    const auto y = static_cast<std::size_t>(p.y);
    const double s = mix(sine[y], sine[y + 1], p.down), sin_theta = std::hypot(local.x, local.z);
    const double row_spacing = pi / (tables_->image.height - 1);
    return luminance(unscaled(p)) * (sin_theta > 0.0 ? s / sin_theta : sine[1] / row_spacing) / total_;
}

}  // namespace neumann
