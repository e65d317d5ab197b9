// What the file of a film begins with.
#include "host/error.h"
#include "host/film/film_header.h"
#include "property.h"
#include "targets.h"

#include <nlohmann/json.hpp>

int parhelion::fuzz::fuzz_film(const std::uint8_t* data, std::size_t size) {
    return answer_or_refusal([&] {
        FilmHeader header;
        try {
            header = film_header(nlohmann::json::parse(as_text(data, size)));
        } catch (const nlohmann::json::exception&) {
            throw InputError("no header"); // as FilmFile says
        }
        const Film& film = header.content.film;
        promise(film.crop_width > 0 && film.crop_height > 0, "there are pixels");
        promise(header.content.channels() > 0, "there are channels");
        promise((header.state.samples - header.all()).empty(), "samples are those of the render");
        for (const BadSample& bad : header.state.bad_samples)
            promise(bad.fault_name() != nullptr, "faults have names");
    });
}
