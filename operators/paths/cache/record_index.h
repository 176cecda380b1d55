// The records near a point: an R-tree of the cubes within which they are read (Boost.Geometry), and how far each is read in each
// direction. A record is not read behind objects that stand on its surface, for example on another room's floor.
#pragma once

#include "core/sampling/warp.h"
#include "operators/paths/cache/record_places.h"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace neumann {

class RecordPlaces::Index {
public:
    // The distances along the surface up to which it is free, in sectors about the record; ∞ is allowed.
    static constexpr std::size_t sectors = 16;
    using Reach = std::array<float, sectors>;

    void add(const Record& record, std::uint32_t number, const Reach& reach_of_record) {
        reach_.push_back(reach_of_record);
        const Vec3 reach(wider * record.radius), low = record.x.position - reach, high = record.x.position + reach;
        tree_.insert({{{low.x, low.y, low.z}, {high.x, high.y, high.z}}, number});
    }
    // Calls f for each record whose cube has y in it.
    template <class F>
    void for_near(const Vec3& y, const F& f) const {
        const Point point(y.x, y.y, y.z);
        tree_.query(boost::geometry::index::intersects(point),
                    boost::make_function_output_iterator([&](const auto& of) { f(of.second); }));
    }

    // Whether the point (x, y) in the record's frame lies on this side of objects that stand on the surface.
    bool reaches(std::uint32_t number, double x, double y) const {
        const auto sector = static_cast<std::size_t>(part_of_circle(x, y) * sectors) % sectors;
        const double reach = double{reach_[number][sector]};
        return x * x + y * y <= reach * reach;
    }

private:
    std::vector<Reach> reach_;
    using Point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using Box = boost::geometry::model::box<Point>;
    boost::geometry::index::rtree<std::pair<Box, std::uint32_t>, boost::geometry::index::rstar<16>> tree_;
};

}  // namespace neumann
