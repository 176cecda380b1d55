// A method, its text and its JSON say the same, whatever its options.
#include "apps/output/files/method_json.h"
#include "core/base/error.h"
#include "operators/render/methods/method_options.h"

#include <gtest/gtest.h>

namespace neumann::method_text_test {

// For each option, a value that is not the usual one.
const std::map<std::string, std::string> values{
    {"direct", "mis-balance"}, {"lights", "power"}, {"roulette", "0.875"},  {"split", "8,3"},  {"sampler", "independent"},
    {"plan", "full"},          {"patches", "345"},  {"directions", "1024"}, {"ways", "3"},     {"importance", "true"},
    {"photons", "5000"},       {"radius", "0.25"},  {"gather", "true"},     {"chain", "64"},   {"adaptive", "sum"},
    {"bias-allowed", "true"},  {"tree", "3"},       {"indirect", "cosine"}, {"reuse", "true"}, {"records", "split-sphere"},
    {"accuracy", "0.5"}};

TEST(MethodText, EveryMethodComesBackFromTextAndJson) {
    for (const std::string& name : method_names()) {
        MethodText given{name};
        for (const MethodOption& o : method_options())
            if (o.belongs_to(make_method({name})) && std::string(o.name) != "tree" && std::string(o.name) != "reuse")
                given.options.emplace_back(o.name, values.at(o.name));
        // These stand in the place of --split, and a tree also of --roulette.
        const MethodText tree{"walk", {{"tree", values.at("tree")}}}, reuse{"walk", {{"reuse", values.at("reuse")}}};
        for (const MethodText& text :
             name == "walk" ? std::vector{MethodText{name}, given, tree, reuse} : std::vector{MethodText{name}, given}) {
            const Method method = make_method(text);
            EXPECT_EQ(name_of(method), name);
            EXPECT_TRUE(make_method(text_of(method)) == method) << name;
            EXPECT_TRUE(make_method(differences_of(method)) == method) << name;
            EXPECT_TRUE(method_from_json(nlohmann::ordered_json::parse(as_json(method).dump())) == method) << name;
        }
        EXPECT_EQ(differences_of(make_method(given)).options.size(), given.options.size()) << name;
        EXPECT_TRUE(differences_of(make_method({name})).options.empty()) << name;
        EXPECT_FALSE(make_method(given) == make_method({name})) << name;
    }
}

TEST(MethodText, AnOptionIsReadByEveryMethodThatHasItAndByNoOther) {
    for (const std::string& name : method_names())
        for (const MethodOption& o : method_options()) {
            const MethodText text{name, {{o.name, values.at(o.name)}}};
            if (o.belongs_to(make_method({name}))) {
                EXPECT_EQ(o.text(make_method(text)), values.at(o.name)) << name << " " << o.name;
            } else {
                EXPECT_THROW(make_method(text), InputError) << name << " " << o.name;
            }
        }
}

TEST(MethodText, AWordIsTheSameAsOptions) {
    EXPECT_TRUE(read_method("walk:direct=bsdf:roulette=0.5") == make_method({"walk", {{"direct", "bsdf"}, {"roulette", "0.5"}}}));
    EXPECT_TRUE(read_method("matrix") == Method(method::Matrix{}));
}

}  // namespace neumann::method_text_test
