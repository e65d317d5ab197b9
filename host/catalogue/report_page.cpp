// The report as a page: verdicts by chapter, and for each function its worst error over its domain.
#include "host/catalogue/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace parhelion::stress {
namespace {

constexpr const char* page_head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Parhelion stress report</title>
<style>
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 75em; color: #222; }
table { border-collapse: collapse; width: 100%; }
td, th { text-align: left; padding: .25em .6em; border-bottom: 1px solid #ddd; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.ok { color: #14803c; } .fails { color: #c01c28; font-weight: bold; }
.where { color: #666; font-size: 12px; word-break: break-all; }
h3 { margin-bottom: .2em; } svg { background: #fafafa; border: 1px solid #ddd; }
</style></head><body>
)";

std::string escaped(const std::string& text) {
    std::string out;
    for (char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '&')
            out += "&amp;";
        else
            out += c;
    }
    return out;
}

constexpr double plot_width = 420, plot_height = 120, plot_margin = 44;

double plot_x(const Curve& c, double x) {
    return plot_margin + (x - c.low) / (c.high - c.low) * (plot_width - 1.5 * plot_margin);
}

/// A bar a bin that anything fell into, the target as a line.
std::string plot(const Check& check) {
    const Curve& c = check.curve;
    double top = check.target;
    for (double w : c.worst)
        if (std::isfinite(w)) top = std::max(top, w);
    if (!(top > 0)) top = 1;
    top *= 1.1;
    auto y = [&](double v) { return plot_height - 24 - v / top * (plot_height - 34); };
    double step = (c.high - c.low) / static_cast<double>(c.worst.size());
    std::string svg =
        fmt::format("<svg width=\"{}\" height=\"{}\" role=\"img\">", plot_width, plot_height);
    for (std::size_t i = 0; i < c.worst.size(); i++) {
        if (c.worst[i] < 0) continue;
        double value = std::isfinite(c.worst[i]) ? c.worst[i] : top;
        double x = plot_x(c, c.low + step * static_cast<double>(i));
        svg += fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>", x,
            y(value), std::max(1., plot_x(c, c.low + step) - plot_x(c, c.low) - .5),
            std::max(.5, y(0) - y(value)), value <= check.target ? "#4a7fb5" : "#c01c28");
    }
    svg += fmt::format("<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" "
                       "stroke=\"#c01c28\" stroke-dasharray=\"4 3\"/>",
                       plot_x(c, c.low), plot_x(c, c.high), y(check.target));
    svg += fmt::format("<text x=\"4\" y=\"{:.1f}\" font-size=\"11\">{:.3g}</text>",
                       y(check.target) + 4, check.target);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" font-size=\"11\">{:g}</text>", plot_x(c, c.low),
                       plot_height - 8, c.low);
    svg +=
        fmt::format("<text x=\"{:.1f}\" y=\"{}\" font-size=\"11\" text-anchor=\"end\">{:g}</text>",
                    plot_x(c, c.high), plot_height - 8, c.high);
    svg +=
        fmt::format("<text x=\"{:.1f}\" y=\"{}\" font-size=\"11\" text-anchor=\"middle\">{}</text>",
                    plot_x(c, (c.low + c.high) / 2), plot_height - 8, escaped(c.axis));
    return svg + "</svg>";
}

std::string check_row(const Check& c) {
    std::string where;
    if (!c.worst_at.empty())
        where = fmt::format("<div class=\"where\">worst at {}</div>", escaped(c.worst_at));
    if (!c.note.empty()) where += fmt::format("<div class=\"where\">{}</div>", escaped(c.note));
    return fmt::format(
        "<tr><td class=\"{}\">{}</td><td>{}{}</td><td class=\"number\">{:.4g}</td><td "
        "class=\"number\">{} {:.4g}</td>"
        "<td>{}</td><td class=\"number\">{}</td><td class=\"number\">{:.3g}</td></tr>\n",
        c.holds() ? "ok" : "fails", c.holds() ? "holds" : "FAILS", escaped(c.name), where, c.value,
        c.at_least ? "&ge;" : "&le;", c.target, escaped(c.unit),
        c.mean >= 0 ? fmt::format("{:.3g}", c.mean) : "", static_cast<double>(c.samples));
}

std::string row_section(const RowResult& r) {
    std::string html =
        fmt::format("<h3 id=\"{0}\">{0}</h3>\n<p>{1} ({2:.1f} "
                    "s)</p>\n<table><tr><th></th><th>check</th><th>value</th>"
                    "<th>target</th><th>unit</th><th>mean</th><th>samples</th></tr>\n",
                    escaped(r.row.name), escaped(r.row.title), r.seconds);
    for (const Check& c : r.checks)
        html += check_row(c);
    html += "</table>\n";
    for (const Check& c : r.checks)
        if (!c.curve.worst.empty())
            html += fmt::format("<figure><figcaption>{}, {}</figcaption>{}</figure>\n",
                                escaped(c.name), escaped(c.unit), plot(c));
    return html;
}

} // namespace

std::string report_page(const Report& report) {
    std::string html = page_head;
    html += fmt::format("<h1>Parhelion stress report</h1>\n<p>{}, {} run, seed {}, {:.0f} s, on {} "
                        "(driver {}).</p>\n"
                        "<p class=\"{}\">{} checks: {}.</p>\n",
                        escaped(report.version), report.effort, report.seed, report.seconds(),
                        escaped(report.device.name), escaped(report.device.driver_version),
                        report.holds() ? "ok" : "fails", report.check_count(),
                        report.holds() ? "all hold" : "NOT all hold");
    std::string chapter;
    for (const RowResult& r : report.rows) {
        if (r.row.chapter != chapter)
            html += fmt::format("<h2>{}</h2>\n", escaped(chapter = r.row.chapter));
        html += row_section(r);
    }
    return html + "</body></html>\n";
}

} // namespace parhelion::stress
