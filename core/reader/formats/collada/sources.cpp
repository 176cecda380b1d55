#include "core/reader/formats/collada/sources.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/collada/file.h"
#include "core/reader/formats/collada/texts.h"

#include <fmt/format.h>

namespace neumann::reader::collada {

namespace {

// The child of e with this tag and the id to which a url refers.
const Element& find_inside(const Element& e, const std::string& tag, const Attribute& url) {
    std::vector<std::string> names;
    const std::string id = url.value.starts_with('#') ? url.value.substr(1) : url.value;
    for (const Element& c : e.children) {
        const Attribute* own = c.tag == tag ? c.find("id") : nullptr;
        if (own && own->value == id) return c;
        if (own) names.push_back(own->value);
    }
    throw InputError(url.place, fmt::format("there is no <{}> '{}' in this <{}>{}", tag, id, e.tag, did_you_mean(id, names)));
}

std::size_t count_or(const Element& e, const std::string& attribute, std::size_t missing) {
    const Attribute* a = e.find(attribute);
    return a ? read_count(*a) : missing;
}

// The named parameters of an accessor, or all if none has a name.
std::vector<std::size_t> used_components(const Element& accessor) {
    std::vector<std::size_t> named;
    std::size_t all = 0;
    for (const Element& param : accessor.children) {
        if (param.tag != "param") continue;
        if (const Attribute* name = param.find("name"); name && !name->value.empty()) named.push_back(all);
        ++all;
    }
    if (named.empty())
        for (std::size_t i = 0; i < all; ++i) named.push_back(i);
    return named;
}

}  // namespace

std::shared_ptr<const std::vector<double>> Sources::array(const Element& source, const Element& accessor) {
    const Element& e = find_inside(source, "float_array", required_attribute(accessor, "source"));
    auto& known = arrays_[&e];
    if (!known) {
        auto values = std::make_shared<std::vector<double>>(read_numbers(e));
        if (const Attribute* count = e.find("count"); count && read_count(*count) != values->size())
            throw wrong_count(e, values->size(), fmt::format("its count, {}", count->value));
        known = std::move(values);
    }
    return known;
}

Source Sources::find(const Element& input, std::size_t components) {
    const Attribute& url = required_attribute(input, "source");
    const Element& source = find_inside(mesh_, "source", url);
    const Element& accessor = required_child(required_child(source, "technique_common"), "accessor");
    const auto values = array(source, accessor);
    const std::size_t offset = count_or(accessor, "offset", 0), stride = count_or(accessor, "stride", 1),
                      count = read_count(required_attribute(accessor, "count"));
    std::vector<std::size_t> used = used_components(accessor);
    if (used.size() < components)
        throw InputError(accessor.place, fmt::format("<accessor> has {} named <param>, expected {} for {}", used.size(), components,
                                                     required_attribute(input, "semantic").value));
    used.resize(components);
    if (used.back() >= stride)
        throw InputError(accessor.place, fmt::format("the stride of <accessor> is {}, expected at least the {} of its <param>s",
                                                     stride, used.back() + 1));
    if (count > 0 && (offset >= values->size() || (count - 1) > (values->size() - offset) / stride ||
                      offset + (count - 1) * stride + used.back() >= values->size()))
        throw InputError(accessor.place, fmt::format("<accessor> reads {} × {} numbers from {} on, but its array has only {}",
                                                     count, stride, offset, values->size()));
    return {values, offset, stride, count, std::move(used)};
}

const Element& Sources::vertices(const Element& input) const {
    return find_inside(mesh_, "vertices", required_attribute(input, "source"));
}

}  // namespace neumann::reader::collada
