#include "core/reader/formats/collada/corners.h"

#include "core/reader/formats/collada/file.h"
#include "core/reader/formats/collada/texts.h"

#include <limits>

#include <fmt/format.h>

namespace neumann::reader::collada {

namespace {

class CornerReader {
public:
    CornerReader(const Element& primitive, std::size_t stride) : primitive_(primitive) { corners_.stride = stride; }

    Corners read() {
        const std::string& tag = primitive_.tag;
        if (tag == "triangles")
            read_triangles();
        else if (tag == "polylist")
            read_polylist();
        else
            read_lists();
        return std::move(corners_);
    }

private:
    std::size_t corner_count() const { return corners_.indices.size() / corners_.stride; }

    // Appends the indices of a <p>, and returns the number of its corners.
    std::size_t append(const Element& p) {
        std::vector<std::uint32_t> indices = read_indices(p);
        if (indices.size() % corners_.stride != 0)
            throw wrong_count(p, indices.size(), fmt::format("a multiple of {}, the indices of a corner", corners_.stride));
        const std::size_t count = indices.size() / corners_.stride;
        if (corners_.indices.empty())
            corners_.indices = std::move(indices);
        else
            corners_.indices.insert(corners_.indices.end(), indices.begin(), indices.end());
        if (corner_count() > std::numeric_limits<std::uint32_t>::max())
            throw InputError(p.place, "more than 2³² corners in one mesh");
        return count;
    }

    void add(std::size_t a, std::size_t b, std::size_t c) {
        corners_.triangles.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
    }

    void add_fan(std::size_t first, std::size_t count) {
        for (std::size_t i = 2; i < count; ++i) add(first, first + i - 1, first + i);
    }

    void add_polygon(std::size_t first, std::size_t count) {
        if (count > 3) corners_.fans.push_back({corners_.triangles.size(), count});
        add_fan(first, count);
    }

    void check_count(std::size_t found) const {
        if (const Attribute* count = primitive_.find("count"); count && read_count(*count) != found)
            throw InputError(count->place,
                             fmt::format("the count of <{}> is {}, but there are {}", primitive_.tag, count->value, found));
    }

    void read_triangles() {
        const Element* p = child(primitive_, "p");
        if (!p) return check_count(0);
        const std::size_t count = append(*p);
        if (count % 3 != 0)
            throw wrong_count(*p, count * corners_.stride, fmt::format("a multiple of {}, three corners", 3 * corners_.stride));
        corners_.triangles.reserve(count / 3);
        for (std::size_t i = 0; i < count; i += 3) add(i, i + 1, i + 2);
        check_count(count / 3);
    }

    void read_polylist() {
        const Element *counts = child(primitive_, "vcount"), *p = child(primitive_, "p");
        if (!counts && !p) return check_count(0);
        const std::vector<std::uint32_t> sizes = read_indices(required_child(primitive_, "vcount"));
        const std::size_t found = append(required_child(primitive_, "p"));
        std::size_t first = 0;
        for (const std::uint32_t size : sizes) {
            if (size < 3) throw InputError(counts->place, fmt::format("a polygon has {} corners, expected at least 3", size));
            if (size > found - first) {
                first = found + 1;
                break;
            }
            add_polygon(first, size);
            first += size;
        }
        if (first != found)
            throw InputError(p->place, fmt::format("<p> has {} corners, but the polygons of <vcount> have {}", found,
                                                   first > found ? "more" : "fewer"));
        check_count(sizes.size());
    }

    // Reads a polygon, a fan or a strip from each <p>.
    void read_lists() {
        std::size_t lists = 0, triangles = 0;
        for (const Element& p : primitive_.children) {
            if (p.tag == "ph") throw InputError(p.place, "a polygon with holes, <ph>, is not supported; expected triangles");
            if (p.tag != "p") continue;
            const std::size_t first = corner_count(), count = append(p);
            if (count < 3) throw InputError(p.place, fmt::format("<p> has {} corners, expected at least 3", count));
            if (primitive_.tag == "tristrips")
                for (std::size_t i = 2; i < count; ++i)
                    add(first + i - 2, first + i - 1 + i % 2, first + i - i % 2);  // every other triangle is turned
            else if (primitive_.tag == "trifans")
                add_fan(first, count);
            else
                add_polygon(first, count);
            ++lists;
            triangles += count - 2;
        }
        // Some programs count the triangles of strips and fans, not the strips and fans.
        if (const Attribute* count = primitive_.find("count"); count && read_count(*count) != triangles) check_count(lists);
    }

    const Element& primitive_;
    Corners corners_;
};

}  // namespace

Corners read_corners(const Element& primitive, std::size_t stride) { return CornerReader(primitive, stride).read(); }

bool has_triangles(const Element& primitive) {
    const std::string& tag = primitive.tag;
    return tag == "triangles" || tag == "polylist" || tag == "polygons" || tag == "trifans" || tag == "tristrips";
}

}  // namespace neumann::reader::collada
