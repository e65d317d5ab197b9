// How a picture is written as an .exr: which component each layer has, and what is refused.
#include "host/commands/picture_form.h"
#include "host/error.h"

#include <catch2/catch.hpp>

using namespace parhelion;
using Catch::Contains;

namespace {

constexpr ComponentFormat half = ComponentFormat::float16, single = ComponentFormat::float32;

AovLayer layer_of_kind(const std::string& name, int kind) { return {name, kind, 0}; }

/// With layers of every kind, called by it.
FilmContent content_of(ComponentFormat component) {
    FilmContent content;
    content.film.component_format = component;
    for (int kind = 0; kind < aov_kind_count; kind++)
        content.aovs.layers.push_back(layer_of_kind(std::string(aov_kinds[kind].name), kind));
    for (int kind = 0; kind < film_aov_kind_count; kind++)
        content.aovs.film_layers.push_back(
            layer_of_kind(std::string(film_aov_kinds[kind].name), kind));
    content.second_moment = true;
    return content;
}

ExrOptions options_of(const PictureForm& form, ComponentFormat component = single) {
    return exr_options(form, content_of(component));
}

std::string refusal(const PictureForm& form) {
    try {
        check_picture_form(form, "a.exr");
        options_of(form);
        return "";
    } catch (const InputError& e) {
        return e.what();
    }
}

} // namespace

TEST_CASE("Picture form: nothing asked is what the scene says, counts and indices in float") {
    CHECK(options_of({}).compression == ExrCompression::zip);
    CHECK(options_of({}).layers.empty());
    const ExrOptions options = options_of({}, half);
    for (const char* name : {"samples.N", "shape_index.I", "prim_index.I"})
        CHECK(options.component_of(name) == single);
    for (const char* name : {"R", "albedo.R", "uv.U", "variance.G", "second_moment.B"})
        CHECK(options.component_of(name) == half);
    CHECK(options_of({}, ComponentFormat::uint32).component_of("samples.N") ==
          ComponentFormat::uint32);
}

TEST_CASE("Picture form: a layer by its name comes before all, in any order") {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"all=half", "image=float", "albedo=float"},
          {"albedo=float", "image=float", "all=half"}}) {
        const ExrOptions options = options_of({.layer_formats = words});
        CHECK(options.component_of("R") == single);
        CHECK(options.component_of("albedo.G") == single);
        CHECK(options.component_of("sh_normal.X") == half);
        CHECK(options.component_of("samples.N") == single);
    }
    const ExrOptions one = options_of({.layer_formats = {"image=half"}});
    CHECK(one.component_of("G") == half);
    CHECK(one.component_of("albedo.G") == single);
    CHECK(options_of({.layer_formats = {"all=float"}}, half).component_of("R") == single);
}

TEST_CASE("Picture form: what cannot be is refused, by name") {
    CHECK(refusal({.compression = "piz", .layer_formats = {"all=half"}}).empty());
    CHECK_THAT(refusal({.compression = "lzw"}), Contains("'lzw'") && Contains("zips"));
    for (const char* text : {"", "albedo", "=half", "albedo=", "albedo=float16", "albedo=Half"})
        CHECK_THAT(refusal({.layer_formats = {text}}), Contains("NAME=half or NAME=float"));
    CHECK_THAT(refusal({.layer_formats = {"beauty=half"}}),
               Contains("'beauty'") && Contains("image, albedo") && Contains("second_moment"));
    CHECK_THAT(refusal({.layer_formats = {"uv=half", "uv=half"}}), Contains("more than once"));
    CHECK_THAT(refusal({.layer_formats = {"samples=half"}}), Contains("2048"));
    CHECK(refusal({.layer_formats = {"samples=float"}}).empty());
    CHECK_THAT(refusal({.compression = "pxr24"}), Contains("whole numbers"));
    CHECK(exr_options({.compression = "pxr24"}, FilmContent{}).compression ==
          ExrCompression::pxr24);
    CHECK_THROWS_WITH(check_picture_form({.compression = "zip"}, "a.png"), Contains(".exr"));
    CHECK_THROWS_WITH(check_picture_form({.layer_formats = {"all=half"}}, "a.film"),
                      Contains("merge"));
    CHECK_NOTHROW(check_picture_form({}, "a.png"));
}
