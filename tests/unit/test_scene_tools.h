// Scenes written for one test: files in a folder of their own, loaded, or refused with a message.
#pragma once

#include "host/scene/load.h"
#include "tests/support/skip.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace parhelion::test {

/// A fresh folder, removed with its content at the end of the test.
class SceneFolder {
public:
    SceneFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "parhelion_XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder: " + name);
        path_ = name;
    }
    ~SceneFolder() { std::filesystem::remove_all(path_); }
    SceneFolder(const SceneFolder&) = delete;
    SceneFolder& operator=(const SceneFolder&) = delete;

    std::string write(const std::string& name, const std::string& content) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << content;
        return file.string();
    }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// `body` inside <scene>, with a sensor and an integrator; the body's first line is line 2.
inline std::string scene_text(const std::string& body, const std::string& version = "3.0.0") {
    return "<scene version=\"" + version + "\">\n" + body +
           "\n<sensor type=\"perspective\"/><integrator type=\"path\"/>\n</scene>\n";
}

inline Scene load_body(const std::string& body, const std::string& version = "3.0.0") {
    const SceneFolder folder;
    return load_scene(folder.write("scene.xml", scene_text(body, version)));
}

/// The message a file is refused with, the folder taken out; "" when it loads.
inline std::string refusal_of(const std::string& file, const LoadOptions& options = {}) {
    try {
        load_scene(file, options);
        return "";
    } catch (const InputError& error) {
        std::string message = error.what();
        const std::string folder = std::filesystem::path(file).parent_path().string() + "/";
        for (std::size_t i; (i = message.find(folder)) != std::string::npos;)
            message.erase(i, folder.size());
        return message;
    }
}

inline std::string refusal_of_text(const std::string& text) {
    const SceneFolder folder;
    return refusal_of(folder.write("scene.xml", text));
}

inline std::string refusal_of_body(const std::string& body) {
    return refusal_of_text(scene_text(body));
}

/// The folder of shared test data, or "" where it is absent, and what needs it is skipped.
inline std::string shared_data() {
    const char* const folder = std::getenv("PARHELION_DATA");
    if (folder && std::filesystem::is_directory(folder)) return folder;
    skip("PARHELION_DATA names no folder with the shared test data");
    return "";
}

} // namespace parhelion::test
