// The records near a point: an R-tree of the cubes within which they are read (Boost.Geometry).
#pragma once

#include "operators/cache/record_places.h"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include <cstdint>
#include <utility>

namespace neumann {

class RecordPlaces::Index {
public:
    void add(const Record& record, std::uint32_t number) {
        const Vec3 reach(wider * record.radius), low = record.x.position - reach, high = record.x.position + reach;
        tree_.insert({{{low.x, low.y, low.z}, {high.x, high.y, high.z}}, number});
    }
    // Calls f for each record whose cube holds y.
    template <class F>
    void for_near(const Vec3& y, const F& f) const {
        const Point point(y.x, y.y, y.z);
        tree_.query(boost::geometry::index::intersects(point),
                    boost::make_function_output_iterator([&](const auto& of) { f(of.second); }));
    }

private:
    using Point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using Box = boost::geometry::model::box<Point>;
    boost::geometry::index::rtree<std::pair<Box, std::uint32_t>, boost::geometry::index::rstar<16>> tree_;
};

}  // namespace neumann
