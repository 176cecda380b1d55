// R for eight walks at once where it is simple: at flat surfaces of constant diffuse reflectance, with light samples on surfaces
// that shine evenly. The arithmetic is that of choose_light_sample() (shadow_rays.h) and of Diffuse::sample(), in the same order,
// so the results have the same bits. Walks are side by side in memory, so that compilers make vector instructions of it.
#pragma once

#include "operators/paths/walk/direct_light.h"
#include "operators/paths/walk/walker.h"

namespace neumann {

class DiffusePacket {
public:
    static constexpr std::size_t size = 8;

    // Whether the light samples are points on surfaces that shine evenly.
    static bool fits(const DirectLightSampler& direct) { return direct.samples_even_points(); }
    // The material on the side of w.x on which w.wo lies, if the surface is flat and the material diffuse and constant;
    // otherwise null.
    static const Diffuse* material(const Materials& materials, const Walker& w) {
        if (!materials.is_flat(w.x.shape)) return nullptr;
        const Bsdf* const bsdf = materials.at(w.x.shape, glm::dot(w.x.normal, w.wo) > 0.0);
        const Diffuse* const diffuse = bsdf ? std::get_if<Diffuse>(bsdf) : nullptr;
        return diffuse && diffuse->is_constant() ? diffuse : nullptr;
    }

    bool is_full() const { return count_ == size; }
    // Adds a walk, and draws the numbers of its light sample and then of its direction.
    template <class Sampler>
    void add(Walker& w, const Diffuse& material, const DirectLightSampler& direct, Sampler& sampler) {
        const std::size_t j = count_++;
        walker_[j] = &w;
        const double cosine = glm::dot(w.x.normal, w.wo);
        const bool front = cosine > 0.0;
        normal_.set(j, front ? w.x.normal : -w.x.normal);
        cosine_[j] = front ? cosine : -cosine;
        x_.set(j, w.x.position);
        const EvenPoint light = direct.sample_even_point(sampler.next2());
        w.shadow_ray.y = light.point;
        y_.set(j, light.point.position);
        normal_of_y_.set(j, light.point.normal);
        radiance_.set(j, light.radiance);
        density_[j] = light.density;
        beta_.set(j, w.beta);
        const Rgb& albedo = material.largest_albedo();
        albedo_.set(j, albedo);
        const Vec2 u = sampler.next2();
        u_[0][j] = u.x;
        u_[1][j] = u.y;
        w.reflected = max_component(albedo);
        w.from = {w.x.position, front ? w.x.normal : -w.x.normal};
    }
    // Reflects the walks that were added, and empties the packet. `directions` is as in choose_light_sample().
    void reflect(const DirectLightSampler& direct, double directions) {
        compute(directions, direct.is_weighted() ? directions : 0.0);  // against a pdf of 0 the weight is 1
        for (std::size_t j = 0; j < count_; ++j) {
            Walker& w = *walker_[j];
            w.shadow_ray.value = value_[j];
            w.shadow_ray.w = to_y_[j];
            w.beta = beta_[j];
            w.pdf = pdf_[j];
            w.w = next_[j];
        }
        count_ = 0;
    }

private:
    class Vectors {
    public:
        Vec3 operator[](std::size_t j) const { return {at_[0][j], at_[1][j], at_[2][j]}; }
        void set(std::size_t j, const Vec3& v) {
            at_[0][j] = v.x;
            at_[1][j] = v.y;
            at_[2][j] = v.z;
        }

    private:
        alignas(32) double at_[3][size]{};
    };
    void compute(double directions, double weighted_directions);

    std::size_t count_ = 0;
    Walker* walker_[size];
    Vectors x_, normal_, y_, normal_of_y_, radiance_, beta_, albedo_;
    // The cosine of wo; the density of y per area; the numbers for the next direction, and its pdf.
    alignas(32) double cosine_[size]{}, density_[size]{}, u_[2][size]{}, pdf_[size]{};
    Vectors value_, to_y_, next_;
};

}  // namespace neumann
