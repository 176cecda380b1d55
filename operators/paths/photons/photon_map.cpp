#include "operators/paths/photons/photon_map.h"

#include <boost/container/small_vector.hpp>
#include <nanoflann.hpp>

#include <limits>

namespace neumann {

namespace {

constexpr float least_cosine = 0.5f;  // least cosine between two normals on the same surface
constexpr double flatness = 0.2;      // how far photons lie above or below x, as a part of the radius

// A result set of nanoflann that hands over all points within a radius.
template <class Each>
struct Within {
    using DistanceType = float;
    float radius2;
    const Each& each;
    std::size_t count = 0;

    std::size_t size() const { return count; }
    bool empty() const { return count == 0; }
    bool full() const { return true; }
    float worstDist() const { return radius2; }
    void sort() const {}
    bool addPoint(float distance2, std::uint32_t i) {
        if (distance2 < radius2) {
            each(distance2, i);
            ++count;
        }
        return true;
    }
};

}  // namespace

struct PhotonMap::Tree {
    struct Points {
        const Photon* photons;  // their address does not change if the map is moved
        std::size_t count;
        std::size_t kdtree_get_point_count() const { return count; }
        float kdtree_get_pt(std::size_t i, std::size_t axis) const { return photons[i].position[static_cast<int>(axis)]; }
        template <class Box>
        bool kdtree_get_bbox(Box&) const {
            return false;
        }
    };
    using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3, std::uint32_t>;

    explicit Tree(const std::vector<Photon>& photons)
        : points{photons.data(), photons.size()}, index(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {
        index.buildIndex();
    }
    Points points;
    Index index;
};

PhotonMap::PhotonMap(std::vector<Photon> photons) : photons_(std::move(photons)) {
    if (!photons_.empty()) tree_ = std::make_unique<const Tree>(photons_);
}
PhotonMap::~PhotonMap() = default;
PhotonMap::PhotonMap(PhotonMap&&) noexcept = default;

void PhotonMap::find(const SurfacePoint& x, double radius, std::vector<NearPhoton>& near) const {
    near.clear();
    if (!tree_) return;
    const glm::vec3 at(x.position), normal(x.normal);
    const auto highest = static_cast<float>(flatness * radius);
    const auto take = [&](float distance2, std::uint32_t i) {
        const Photon& photon = photons_[i];
        if (std::abs(glm::dot(photon.normal, normal)) < least_cosine || std::abs(glm::dot(photon.position - at, normal)) > highest)
            return;
        near.push_back({&photon, double{distance2}});
    };
    Within<decltype(take)> within{static_cast<float>(radius * radius), take};
    tree_->index.findNeighbors(within, &at.x, {});
}

double PhotonMap::distance(const Vec3& x, std::size_t k) const {
    if (photons_.size() < k) return std::numeric_limits<double>::infinity();
    const glm::vec3 at(x);
    boost::container::small_vector<std::uint32_t, 32> which(k);
    boost::container::small_vector<float, 32> distance2(k);
    tree_->index.knnSearch(&at.x, k, which.data(), distance2.data());
    return std::sqrt(double{distance2.back()});
}

}  // namespace neumann
