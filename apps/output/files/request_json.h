// A request in JSON, option by option as in its table, and the way back.
#pragma once

#include "apps/requests/option.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace neumann {

// {"scene": "room.xml", "spp": 64, "lenient": true, …}: the options that differ from the defaults and last.
template <class Request>
nlohmann::ordered_json as_json(const Options<Request>& options, const Request& request) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    const Request usual;
    for (const Option<Request>& o : options.all) {
        const std::vector<std::string> texts = o.texts(request);
        if (!o.lasts || texts == o.texts(usual)) continue;
        if (o.kind == OptionWords::Kind::many)
            json[o.name] = texts;
        else if ((o.kind == OptionWords::Kind::flag || o.is_number) && nlohmann::ordered_json::accept(texts.front()))
            json[o.name] = nlohmann::ordered_json::parse(texts.front());
        else
            json[o.name] = texts.front();
    }
    return json;
}

// Reads a request. Names may be spelled as on the command line, and values be lists of texts, as version 0.1 wrote
// run.json. Throws InputError that begins with `file`, or the JSON library's exception if it is no object.
template <class Request>
Request request_from_json(const Options<Request>& options, const nlohmann::ordered_json& json, const std::string& file) try {
    Given given;
    const auto text = [](const nlohmann::ordered_json& value) {
        return value.is_string() ? value.get<std::string>() : value.dump();
    };
    for (const auto& [name, value] : json.items()) {
        std::vector<std::string> texts;
        if (value.is_array())
            for (const auto& one : value) texts.push_back(text(one));
        else
            texts.push_back(text(value));
        given.emplace_back(name, std::move(texts));
    }
    Request request;
    take(options, given, request, [](const OptionWords& o) { return o.name; });
    return request;
} catch (const InputError& error) {
    throw InputError(file + ": what was asked of it is damaged: " + error.what());
}

}  // namespace neumann
