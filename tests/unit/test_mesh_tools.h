// Mesh files written by the tests.
#pragma once

#include "test_scene_tools.h"

#include <fmt/format.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <zlib.h>

#include <bit>
#include <cstring>

namespace parhelion::test {

/// The message of the InputError that `load` throws; "" where it throws none.
template<typename Load>
std::string refusal(Load load) {
    try {
        load();
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

template<typename T>
void put(std::string& bytes, T value, bool big_endian = false) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof value);
    if (big_endian) std::reverse(raw, raw + sizeof raw);
    bytes.append(raw, sizeof raw);
}

/// One mesh of a serialized file: magic, version and `content` deflated.
inline std::string serialized_content(const std::string& content, std::uint16_t version) {
    uLongf size = compressBound(content.size());
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size,
             reinterpret_cast<const Bytef*>(content.data()), content.size());
    std::string result;
    put(result, std::uint16_t(0x041c));
    put(result, version);
    return result + packed.substr(0, size);
}

/// A mesh to be written in any of the formats.
struct PlainMesh {
    std::vector<glm::dvec3> positions, normals;
    std::vector<glm::dvec2> uvs;
    std::vector<std::vector<std::uint32_t>> faces;
};

inline std::string as_obj(const PlainMesh& mesh) {
    std::string text;
    for (const glm::dvec3& p : mesh.positions)
        text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const glm::dvec3& n : mesh.normals)
        text += fmt::format("vn {} {} {}\n", n.x, n.y, n.z);
    for (const glm::dvec2& uv : mesh.uvs)
        text += fmt::format("vt {} {}\n", uv.x, uv.y);
    for (const auto& face : mesh.faces) {
        text += "f";
        for (const std::uint32_t i : face)
            text +=
                fmt::format(" {0}/{1}/{2}", i + 1, mesh.uvs.empty() ? "" : std::to_string(i + 1),
                            mesh.normals.empty() ? "" : std::to_string(i + 1));
        text += "\n";
    }
    return text;
}

inline std::string ply_header_of(const PlainMesh& mesh, const std::string& format) {
    std::string text =
        fmt::format("ply\nformat {} 1.0\nelement vertex {}\n", format, mesh.positions.size());
    for (const char* const name : {"x", "y", "z"})
        text += fmt::format("property double {}\n", name);
    for (const char* const name : {"nx", "ny", "nz"})
        if (!mesh.normals.empty()) text += fmt::format("property double {}\n", name);
    for (const char* const name : {"u", "v"})
        if (!mesh.uvs.empty()) text += fmt::format("property double {}\n", name);
    return text +
           fmt::format("element face {}\nproperty list int uint vertex_indices\nend_header\n",
                       mesh.faces.size());
}

/// All numbers of a vertex in the order of PLY's header.
inline std::vector<double> numbers_of(const PlainMesh& mesh, std::size_t i) {
    std::vector<double> numbers = {mesh.positions[i].x, mesh.positions[i].y, mesh.positions[i].z};
    if (!mesh.normals.empty())
        for (int k = 0; k < 3; ++k)
            numbers.push_back(mesh.normals[i][k]);
    if (!mesh.uvs.empty())
        for (int k = 0; k < 2; ++k)
            numbers.push_back(mesh.uvs[i][k]);
    return numbers;
}

inline std::string as_ply_text(const PlainMesh& mesh) {
    std::string text = ply_header_of(mesh, "ascii");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        text += fmt::format("{}\n", fmt::join(numbers_of(mesh, i), " "));
    for (const auto& face : mesh.faces)
        text += fmt::format("{} {}\n", face.size(), fmt::join(face, " "));
    return text;
}

inline std::string as_ply_bytes(const PlainMesh& mesh, bool big_endian) {
    std::string bytes =
        ply_header_of(mesh, big_endian ? "binary_big_endian" : "binary_little_endian");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        for (const double number : numbers_of(mesh, i))
            put(bytes, number, big_endian);
    for (const auto& face : mesh.faces) {
        put(bytes, static_cast<std::int32_t>(face.size()), big_endian);
        for (const std::uint32_t i : face)
            put(bytes, i, big_endian);
    }
    return bytes;
}

/// Of triangles alone.
inline std::string as_serialized(const PlainMesh& mesh) {
    std::string content;
    put(content, 0x2000u | (mesh.normals.empty() ? 0u : 1u) | (mesh.uvs.empty() ? 0u : 2u));
    put(content, std::uint64_t(mesh.positions.size()));
    put(content, std::uint64_t(mesh.faces.size()));
    for (const auto* const vectors : {&mesh.positions, &mesh.normals})
        for (const glm::dvec3& v : *vectors)
            for (int k = 0; k < 3; ++k)
                put(content, v[k]);
    for (const glm::dvec2& uv : mesh.uvs)
        for (int k = 0; k < 2; ++k)
            put(content, uv[k]);
    for (const auto& face : mesh.faces)
        for (const std::uint32_t i : face)
            put(content, i);
    return serialized_content(content, 3);
}

} // namespace parhelion::test
