// Reads the arrays of a <mesh>, to which its inputs refer.
#pragma once

#include "core/reader/xml/element.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace neumann::reader::collada {

// A list of vectors in an array of numbers.
class Source {
public:
    Source(std::shared_ptr<const std::vector<double>> values, std::size_t offset, std::size_t stride, std::size_t count,
           std::vector<std::size_t> components)
        : values_(std::move(values)), offset_(offset), stride_(stride), count_(count), components_(std::move(components)) {}

    std::size_t count() const { return count_; }
    double at(std::size_t i, std::size_t component) const { return (*values_)[offset_ + i * stride_ + components_[component]]; }

private:
    std::shared_ptr<const std::vector<double>> values_;
    std::size_t offset_, stride_, count_;
    std::vector<std::size_t> components_;  // offsets of the named components
};

class Sources {
public:
    explicit Sources(const Element& mesh) : mesh_(mesh) {}

    // The source to which an <input> refers, which must have this many components. Throws InputError if there is no
    // such source or no numbers, or too few of them.
    Source find(const Element& input, std::size_t components);
    // The <vertices> to which an <input> refers.
    const Element& vertices(const Element& input) const;

private:
    std::shared_ptr<const std::vector<double>> array(const Element& source, const Element& accessor);
    const Element& mesh_;
    std::map<const Element*, std::shared_ptr<const std::vector<double>>> arrays_;
};

}  // namespace neumann::reader::collada
