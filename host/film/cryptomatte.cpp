// Cryptomatte 1.2.
#include "host/film/cryptomatte.h"

#include "host/error.h"
#include "host/parallel.h"
#include "host/scene/scene.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <string_view>

namespace parhelion {
namespace {

constexpr std::string_view component_names = "RGBA";

std::uint32_t mixed(std::uint32_t word) { return std::rotl(word * 0xcc9e2d51u, 15) * 0x1b873593u; }

struct Rank {
    std::uint32_t id;
    std::int64_t weight;
};

/// What covers a pixel, by name, the largest first; `begin` to `end`: of one pixel.
std::vector<Rank> ranks_of(const ShapeWeight* begin, const ShapeWeight* end,
                           const std::vector<std::uint32_t>& ids) {
    std::vector<Rank> ranks;
    for (const ShapeWeight* w = begin; w != end; ++w) {
        if (w->shape == no_shape) continue;
        const std::uint32_t id = ids[static_cast<std::size_t>(w->shape)];
        const auto known =
            std::find_if(ranks.begin(), ranks.end(), [&](const Rank& r) { return r.id == id; });
        if (known == ranks.end())
            ranks.push_back({id, w->weight});
        else
            known->weight += w->weight;
    }
    // Lobes of a filter below 0 cover nothing.
    std::erase_if(ranks, [](const Rank& r) { return r.weight <= 0; });
    std::sort(ranks.begin(), ranks.end(), [](const Rank& a, const Rank& b) {
        return a.weight != b.weight ? a.weight > b.weight : a.id < b.id;
    });
    return ranks;
}

/// The planes of a layer: of each rank its id, then its share of the pixel.
using Planes = std::vector<std::vector<float>>;

void set_pixel(const ShapeWeight* begin, const ShapeWeight* end,
               const std::vector<std::uint32_t>& ids, std::size_t pixel, Planes& planes) {
    std::int64_t all = 0;
    for (const ShapeWeight* w = begin; w != end; ++w)
        all += w->weight;
    if (all <= 0) return;
    const std::vector<Rank> ranks = ranks_of(begin, end, ids);
    for (std::size_t r = 0; r < ranks.size() && 2 * r + 1 < planes.size(); r++) {
        planes[2 * r][pixel] = std::bit_cast<float>(ranks[r].id);
        planes[2 * r + 1][pixel] =
            static_cast<float>(static_cast<double>(ranks[r].weight) / static_cast<double>(all));
    }
}

void set_row(const ShapeWeights& row, const std::vector<std::uint32_t>& ids, std::size_t first,
             Planes& planes) {
    for (std::size_t begin = 0, end = 0; begin < row.size(); begin = end) {
        while (end < row.size() && row[end].place == row[begin].place)
            end++;
        set_pixel(&row[begin], row.data() + end, ids,
                  first + static_cast<std::size_t>(row[begin].place), planes);
    }
}

std::vector<std::uint32_t> ids_of(const CryptomatteLayer& layer) {
    std::vector<std::uint32_t> ids;
    ids.reserve(layer.names.size());
    for (const std::string& name : layer.names)
        ids.push_back(cryptomatte_id(name));
    return ids;
}

void add_header(const CryptomatteLayer& layer, Image& image) {
    nlohmann::json manifest = nlohmann::json::object();
    for (const std::string& name : layer.names)
        manifest[name] = fmt::format("{:08x}", cryptomatte_id(name));
    const std::string prefix =
        fmt::format("cryptomatte/{:.7}/", fmt::format("{:08x}", cryptomatte_id(layer.name)));
    image.metadata.emplace_back(prefix + "name", layer.name);
    image.metadata.emplace_back(prefix + "hash", std::string("MurmurHash3_32"));
    image.metadata.emplace_back(prefix + "conversion", std::string("uint32_to_float32"));
    image.metadata.emplace_back(
        prefix + "manifest",
        manifest.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

} // namespace

Cryptomatte cryptomatte_of(const Scene& scene) {
    const CryptomatteRequest& asked = scene.integrator.cryptomatte;
    Cryptomatte out;
    out.depth = asked.depth;
    if (asked.objects) out.layers.push_back({"CryptoObject", {}});
    if (asked.materials) out.layers.push_back({"CryptoMaterial", {}});
    for (const CryptomatteLayer& layer : out.layers)
        for (const AovRequest& aov : scene.integrator.aovs)
            if (aov.name.starts_with(layer.name))
                throw InputError(fmt::format("{}: a layer '{}' is none of Cryptomatte's {}",
                                             aov.location.to_string(), aov.name, layer.name));
    for (const Shape& shape : scene.shapes)
        for (CryptomatteLayer& layer : out.layers)
            layer.names.push_back(layer.name == "CryptoObject" ? shape.id : shape.bsdf_id);
    return out;
}

std::uint32_t murmur_hash(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return std::uint32_t{static_cast<unsigned char>(text[i])} << 8 * (i % 4);
    };
    std::uint32_t hash = 0;
    const std::size_t whole = text.size() / 4 * 4;
    for (std::size_t i = 0; i < whole; i += 4)
        hash = std::rotl(hash ^ mixed(byte(i) | byte(i + 1) | byte(i + 2) | byte(i + 3)), 13) * 5 +
               0xe6546b64u;
    std::uint32_t rest = 0;
    for (std::size_t i = whole; i < text.size(); i++)
        rest |= byte(i);
    hash ^= mixed(rest) ^ static_cast<std::uint32_t>(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

std::uint32_t cryptomatte_id(std::string_view name) {
    const std::uint32_t hash = murmur_hash(name), exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

std::vector<std::string> channel_layers(const CryptomatteLayer& layer, int depth) {
    std::vector<std::string> names;
    for (int k = 0; 2 * k < depth; k++)
        names.push_back(fmt::format("{}{:02}", layer.name, k));
    return names;
}

void add_cryptomatte_header(const Cryptomatte& cryptomatte, Image& image) {
    for (const CryptomatteLayer& layer : cryptomatte.layers)
        add_header(layer, image);
}

void add_cryptomatte(const FilmSums& sums, const Cryptomatte& cryptomatte, int first_row,
                     Image& image) {
    if (cryptomatte.layers.empty()) return;
    const auto depth = static_cast<std::size_t>(cryptomatte.depth);
    std::vector<std::vector<std::uint32_t>> ids;
    for (const CryptomatteLayer& layer : cryptomatte.layers)
        ids.push_back(ids_of(layer));
    std::vector<Planes> planes(ids.size(),
                               Planes(2 * depth, std::vector<float>(image.pixel_count())));
    parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t y) {
        ShapeWeights row;
        sums.add_coverage(first_row + static_cast<int>(y), row);
        add_up(row);
        for (std::size_t l = 0; l < planes.size(); l++)
            set_row(row, ids[l], y * static_cast<std::size_t>(image.width), planes[l]);
    });
    for (std::size_t l = 0; l < planes.size(); l++) {
        const CryptomatteLayer& layer = cryptomatte.layers[l];
        const std::vector<std::string> names = channel_layers(layer, cryptomatte.depth);
        planes[l].resize(4 * names.size(), std::vector<float>(image.pixel_count()));
        for (std::size_t c = 0; c < planes[l].size(); c++)
            add_channel(image, fmt::format("{}.{}", names[c / 4], component_names[c % 4]),
                        std::move(planes[l][c]));
    }
}

} // namespace parhelion
