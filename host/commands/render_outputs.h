// What a render writes at its end, and what may be there before.
#pragma once

#include "host/commands/render.h"
#include "host/film/film_file.h"
#include "host/image/write_image.h"
#include "host/render/session.h"

namespace parhelion {

/// Whether the film itself is asked for, to be merged.
bool writes_film(const RenderCommand& command);

/// Refuses, before anything is done, outputs that could not be written later. Where a render goes
/// on with another (--resume, --continue), what that has left of its picture may be there: see
/// check_left_over. Throws InputError.
void check_outputs(const RenderCommand& command);

/// Whether the output that is there, if there is one, may be replaced by that of the render of this
/// digest: by --force, or because it is what such a render left when it was stopped. Nothing where
/// a render that goes on finds its own output, whole: there is nothing to be done. Throws
/// InputError for another. `form`: what the output is to be written as; one that is not may be
/// replaced.
std::optional<Existing> check_left_over(const RenderCommand& command, const std::string& digest,
                                        const ExrOptions& form);

/// What the header of a picture says of its render.
std::vector<std::pair<std::string, MetadataValue>>
metadata_of(const Scene& scene, const RenderReport& report, const std::string& digest);

/// Of the film of a render that is opened, with nothing on it.
FilmHeader header_of(const RenderCommand& command, const Scene& scene, const RenderKey& key,
                     const OpenedRender& opened);

/// Writes the picture of a film; its header says where samples are not all there. Says and returns
/// what the file does not hold as it is. Throws as write_image does.
std::vector<Misfits> write_picture(const std::string& file, const FilmHeader& header,
                                   const FilmSums& sums, const WriteOptions& options);

} // namespace parhelion
