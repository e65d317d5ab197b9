// A device that traces the waves of a render.
#include "host/render/device_engine.h"

#include "host/error.h"
#include "host/film/film_file.h"
#include "host/film/tiled_film.h"
#include "host/render/device_render.h"
#include "host/render/wave_hits.h"
#include "host/waves/render_params.h"

#include <fmt/format.h>

#include <deque>
#include <stdexcept>

namespace parhelion {
namespace {

/// The film of a device's buffers.
class DeviceFilm : public FilmSums {
public:
    /// `first_band`: that of the first buffer.
    DeviceFilm(const DeviceWaves& waves, int first_band, const FilmLayout& layout, const Film& crop,
               const CoverageTiles* coverage)
        : views_(waves.film_views<const cl_uint>()),
          film_(in_their_places(values(views_), first_band, layout), layout, crop, coverage) {}

    void add_row(int channel, int y, SumRow& row) const override { film_.add_row(channel, y, row); }
    void add_coverage(int y, ShapeWeights& row) const override { film_.add_coverage(y, row); }

    template<class Word>
    static std::vector<std::span<Word>> values(const std::deque<BufferView<Word>>& views) {
        std::vector<std::span<Word>> all;
        all.reserve(views.size());
        for (const BufferView<Word>& view : views)
            all.push_back(view.values());
        return all;
    }

private:
    using Bands = std::vector<std::span<const cl_uint>>;
    static Bands in_their_places(const Bands& views, int first_band, const FilmLayout& layout) {
        Bands all(static_cast<std::size_t>(layout.bands()));
        std::copy(views.begin(), views.end(), all.begin() + first_band);
        return all;
    }

    std::deque<BufferView<const cl_uint>> views_;
    TiledFilm film_;
};

/// A film and what is put aside of it.
class TwoFilms : public FilmSums {
public:
    TwoFilms(std::unique_ptr<FilmSums> here, const FilmSums& aside)
        : here_(std::move(here)), both_({here_.get(), &aside}) {}

    void add_row(int channel, int y, SumRow& row) const override { both_.add_row(channel, y, row); }
    void add_coverage(int y, ShapeWeights& row) const override { both_.add_coverage(y, row); }

private:
    std::unique_ptr<FilmSums> here_;
    AddedFilms both_;
};

/// Throws OutputError for a folder whose disk has no room.
std::unique_ptr<FilmStore> make_store(const FilmLayout& layout, const Film& crop, int samples,
                                      const std::string& folder) {
    constexpr double megabyte = 1 << 20;
    const std::uint64_t wanted = usual_store_bytes(layout, crop, samples),
                        there = free_disk_bytes(folder);
    if (there < wanted)
        throw OutputError(fmt::format(
            "{}: the film is more than fits into memory and takes about {:.0f} MB of disk; here "
            "are {:.0f} MB free (accepted: another folder, --scratch; a smaller --size; a part of "
            "it, --crop)",
            folder, static_cast<double>(wanted) / megabyte, static_cast<double>(there) / megabyte));
    return std::make_unique<FilmStore>(folder, crop.crop_width, crop.crop_height,
                                       layout.channels());
}

} // namespace

DeviceEngine::DeviceEngine(RenderDevice& device, DeviceScene scene, DeviceWaves waves)
    : device_(device), scene_(std::move(scene)), waves_(std::move(waves)) {}

DeviceEngine::~DeviceEngine() {
    if (!device_.keeps_scenes) return;
    device_.scene.emplace();
    device_.scene->texels = std::move(scene_.texels);
    device_.scene->images = std::move(scene_.images);
}

WorkSizes DeviceEngine::allocate(const Scene& scene, const AovPlan& aovs, bool checked,
                                 const std::string& scratch, std::span<const WorkSizes> sizes) {
    crop_ = scene.film;
    const WorkSizes& wanted = sizes.front();
    if (wanted.bands_at_once < wanted.film.bands())
        store_ = make_store(wanted.film, crop_, scene.sampler.samples_per_pixel, scratch);
    const auto params = [&](const WorkSizes& s) { return render_params(scene, scene_, s, aovs); };
    waves_.upload(scene_);
    sizes_ = waves_.allocate(sizes, params);
    loop_ = wave_loop(sizes_, params(sizes_), scene_.features.on());
    if (sizes_.film.shape_ids)
        coverage_.emplace(sizes_.film.window, crop_, scene_.filter_values, blocks_at_once());
    checked_ = checked;
    return sizes_;
}

void DeviceEngine::trace(WaveSchedule& schedule, const std::function<void()>& on_wave) {
    trace_waves(std::span(waves_.streams()), schedule, loop_, on_wave,
                [&](WaveStream& stream, const Wave& wave) { gather_hits(stream, wave); });
    if (checked_) check_bounds();
}

int DeviceEngine::blocks_at_once() const {
    return store_ ? sizes_.film.band_blocks : sizes_.film.blocks();
}

void DeviceEngine::turn_to(int first_block) {
    const int band = first_block / sizes_.film.band_blocks;
    if (!store_ || band == band_) return;
    const auto [first, end] = sizes_.film.band_rows(band_, crop_);
    store_->add(*film_in_memory(), first, end);
    waves_.clear_films();
    if (coverage_) coverage_->turn_to(band * sizes_.film.band_blocks);
    band_ = band;
}

std::unique_ptr<FilmSums> DeviceEngine::film_in_memory() {
    return std::make_unique<DeviceFilm>(waves_, band_, sizes_.film, crop_,
                                        coverage_ ? &*coverage_ : nullptr);
}

std::unique_ptr<FilmSums> DeviceEngine::film() {
    if (!store_) return film_in_memory();
    return std::make_unique<TwoFilms>(film_in_memory(), *store_);
}

void DeviceEngine::fill_film(const FilmSums& sums) {
    if (store_) return store_->add(sums, 0, crop_.crop_height);
    const auto views = waves_.film_views<cl_uint>();
    put_sums(sums, sizes_.film, crop_, DeviceFilm::values(views));
    if (coverage_) coverage_->add_film(sums);
}

TraceCounts DeviceEngine::counts() { return counts_of(waves_.read_statistics()); }

void DeviceEngine::report(RenderReport& report) {
    report.stages = waves_.stage_reports();
    report.device_pool_bytes = waves_.pool_bytes();
    report.device_film_bytes = waves_.film_bytes();
    if (store_) report.film_scratch_bytes = store_->bytes();
}

void DeviceEngine::gather_hits(WaveStream& stream, const Wave& wave) {
    if (!coverage_) return;
    const std::size_t slots = std::size_t{BLOCK_PIXELS} * wave.blocks() * wave.samples();
    add_hits<float>(*coverage_, wave, sizes_.film,
                    [&](int channel) { return stream.read_results(channel, slots); });
}

void DeviceEngine::check_bounds() {
    for (WaveStream& stream : waves_.streams())
        if (const char* buffer = stream.read_outside())
            throw std::logic_error(
                fmt::format("a kernel reads or writes outside of its buffers, from {} on", buffer));
}

} // namespace parhelion
