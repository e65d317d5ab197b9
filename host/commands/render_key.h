// What a render is made from: films of two renders can be added up, or gone on with, where it is
// the same.
#pragma once

#include "host/commands/render.h"
#include "host/file_digests.h"
#include "host/film/film_file.h"

namespace parhelion {

/// This program and its kernels; the scene's file and all that it was read from, by content; the
/// options that have a say in what is on the film, but for --spp. Reads the files once more; throws
/// InputError where one cannot be read.
/// `digests`, where there is one, knows those of files that were read before.
RenderKey render_key(const RenderCommand& command, const Scene& scene,
                     FileDigests* digests = nullptr);

/// One for a key and the samples of a pixel.
std::string render_digest(const RenderKey& key, int samples_per_pixel);

/// Throws InputError, in one line, where the film of a file is of another render than `key`, naming
/// what differs first.
void check_same_render(const FilmFile& film, const RenderKey& key);

} // namespace parhelion
