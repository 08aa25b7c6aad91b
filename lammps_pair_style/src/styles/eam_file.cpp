// SPDX-License-Identifier: GPL-2.0-or-later
#include "eam_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace dch::lammps {
namespace {

/// Lines of a file, without comments.
class Lines {
 public:
  explicit Lines(const std::string& text) : text_(text) {}

  std::string title() {
    std::string line;
    std::getline(text_, line);
    return line;
  }
  /// Words of the next line that has some; none at the end.
  std::vector<std::string> words() {
    std::string line;
    while (std::getline(text_, line)) {
      std::istringstream rest(line.substr(0, line.find('#')));
      std::vector<std::string> words;
      for (std::string word; rest >> word;) words.push_back(word);
      if (!words.empty()) return words;
    }
    return {};
  }
  /// So many numbers, from the next line on; none if there are others, or too few.
  std::vector<double> numbers(std::size_t count) {
    std::vector<double> found;
    while (found.size() < count) {
      const std::vector<std::string> line = words();
      if (line.empty()) return {};
      for (const std::string& word : line) {
        char* end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (end != word.c_str() + word.size() || !std::isfinite(value)) return {};
        found.push_back(value);
      }
    }
    if (found.size() > count) found.clear();
    return found;
  }

 private:
  std::istringstream text_;
};

std::string units_of(const std::string& title) {
  std::istringstream words(title);
  for (std::string word; words >> word;)
    if (word == "UNITS:" && words >> word) return word;
  return {};
}

/// Counts and steps of both kinds of functions; counts are 0 if the line does not say them.
struct Steps {
  std::size_t densities = 0, distances = 0;
  double density = 0, distance = 0;
  double last_density = 0;  ///< of the longest function

  static Steps of(Lines& lines) {
    const std::vector<double> given = lines.numbers(5);
    const auto is_count = [](double n) { return n >= 5 && n < 1e8 && n == std::floor(n); };
    if (given.empty() || !is_count(given[0]) || !is_count(given[2]) || !(given[1] > 0) || !(given[3] > 0))
      return {};
    return {static_cast<std::size_t>(given[0]), static_cast<std::size_t>(given[2]), given[1], given[3], 0};
  }
};

EamFile read_one_element(Lines& lines, EamFile file) {
  if (lines.words().size() < 2) return {};
  const Steps steps = Steps::of(lines);
  if (steps.densities == 0) return {};
  file.density_step = steps.density;
  file.distance_step = steps.distance;
  // The three functions go on in one line where one ends.
  const std::vector<double> all = lines.numbers(steps.densities + 2 * steps.distances);
  if (all.empty()) return {};
  const auto first = all.begin(), second = first + static_cast<std::ptrdiff_t>(steps.densities),
             third = second + static_cast<std::ptrdiff_t>(steps.distances);
  file.elements = {{}};
  file.embeddings = {{first, second}};
  file.pairs = {{second, third}};
  file.densities = {{third, all.end()}};
  return file;
}

EamFile read_elements(Lines& lines, EamFile file, bool by_pairs) {
  lines.title();
  lines.title();
  const std::vector<std::string> names = lines.words();
  const Steps steps = Steps::of(lines);
  const std::size_t count = names.empty() ? 0 : names.size() - 1;
  if (count == 0 || names[0] != std::to_string(count) || steps.densities == 0) return {};
  file.density_step = steps.density;
  file.distance_step = steps.distance;
  const auto add = [&lines](std::vector<std::vector<double>>& to, std::size_t numbers) {
    to.push_back(lines.numbers(numbers));
    return !to.back().empty();
  };
  for (std::size_t a = 0; a < count; ++a) {
    if (lines.words().size() < 2 || !add(file.embeddings, steps.densities)) return {};
    for (std::size_t b = 0; b < (by_pairs ? count : 1); ++b)
      if (!add(file.densities, steps.distances)) return {};
  }
  for (std::size_t pair = 0; pair < count * (count + 1) / 2; ++pair)
    if (!add(file.pairs, steps.distances)) return {};
  file.elements.assign(names.begin() + 1, names.end());
  return file;
}

/// By the cubic through four values, the middle two on both sides wherever there are so many.
double between(const std::vector<double>& values, double along) {
  const auto last = static_cast<double>(values.size()) - 3;
  const double knot = std::max(1.0, std::min(std::floor(along), last)), p = std::min(along - knot, 2.0);
  const auto k = static_cast<std::size_t>(knot);
  return -p * (p - 1) * (p - 2) / 6 * values[k - 1] + (p * p - 1) * (p - 2) / 2 * values[k] -
         p * (p + 1) * (p - 2) / 2 * values[k + 1] + p * (p * p - 1) / 6 * values[k + 2];
}

std::vector<double> values_between(const std::vector<double>& given, double step, std::size_t count,
                                   double wanted_step) {
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k)
    values[k] = between(given, static_cast<double>(k) * wanted_step / step);
  return values;
}

/// Steps that the plain style reads files of one element at: the widest, as far as the longest function goes.
Steps common_steps(const std::vector<EamFile>& files, const EamTypes& types) {
  Steps all;
  double distance = 0, density = 0;
  for (const EamTypes::Element& of_type : types.elements) {
    if (of_type.file < 0) continue;
    const EamFile& file = files[static_cast<std::size_t>(of_type.file)];
    all.distance = std::max(all.distance, file.distance_step);
    all.density = std::max(all.density, file.density_step);
    distance = std::max(distance, static_cast<double>(file.pairs[0].size() - 1) * file.distance_step);
    density = std::max(density, static_cast<double>(file.embeddings[0].size() - 1) * file.density_step);
  }
  all.last_density = density;
  all.distances = static_cast<std::size_t>(distance / all.distance + 0.5);
  all.densities = static_cast<std::size_t>(density / all.density + 0.5);
  return all;
}

/// Of eV and lengths of Angstrom from charges, with the numbers of the plain style.
constexpr double kOfCharges = 27.2 * 0.529;

EmbeddedAtomParams of_single_elements(const std::vector<EamFile>& files, const EamTypes& types) {
  const Steps steps = common_steps(files, types);
  const std::size_t n = types.elements.size();
  EmbeddedAtomParams params;
  params.types = static_cast<int>(n);
  params.distance_step = steps.distance;
  params.density_step = steps.density;
  params.line_from = steps.last_density;  // one step behind the last value
  params.densities.assign(n * n, std::vector<double>(steps.distances));
  params.pairs = params.densities;
  params.embeddings.assign(n, std::vector<double>(steps.densities));
  std::vector<std::vector<double>> densities(n, std::vector<double>(steps.distances)), charges(densities);
  for (std::size_t a = 0; a < n; ++a) {
    if (types.elements[a].file < 0) continue;
    const EamFile& file = files[static_cast<std::size_t>(types.elements[a].file)];
    const auto of_distance = [&](const std::vector<double>& given) {
      return values_between(given, file.distance_step, steps.distances, steps.distance);
    };
    params.embeddings[a] =
        values_between(file.embeddings[0], file.density_step, steps.densities, steps.density);
    densities[a] = of_distance(file.densities[0]);
    charges[a] = of_distance(file.pairs[0]);
  }
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      params.densities[a * n + b] = densities[b];
      for (std::size_t k = 0; k < steps.distances; ++k)
        params.pairs[a * n + b][k] = kOfCharges * charges[a][k] * charges[b][k];
    }
  return params;
}

}  // namespace

EamFile read_eam(const std::string& text, EamFormat format) {
  Lines lines(text);
  EamFile file;
  file.units = units_of(lines.title());
  if (format == EamFormat::funcfl) return read_one_element(lines, file);
  return read_elements(lines, file, format == EamFormat::finnis_sinclair);
}

EmbeddedAtomParams functions_of(const std::vector<EamFile>& files, EamFormat format, const EamTypes& types) {
  if (format == EamFormat::funcfl) return of_single_elements(files, types);
  const EamFile& file = files.back();
  const std::size_t n = types.elements.size(), elements = file.elements.size();
  EmbeddedAtomParams params;
  params.types = static_cast<int>(n);
  params.distance_step = file.distance_step;
  params.density_step = file.density_step;
  params.densities.assign(n * n, std::vector<double>(file.pairs[0].size()));
  params.pairs = params.densities;
  params.embeddings.assign(n, std::vector<double>(file.embeddings[0].size()));
  for (std::size_t a = 0; a < n; ++a) {
    if (types.elements[a].file < 0) continue;
    const auto first = static_cast<std::size_t>(types.elements[a].number);
    params.embeddings[a] = file.embeddings[first];
    for (std::size_t b = 0; b < n; ++b) {
      if (types.elements[b].file < 0) continue;
      const auto second = static_cast<std::size_t>(types.elements[b].number);
      const std::size_t more = std::max(first, second), less = std::min(first, second);
      params.densities[a * n + b] =
          file.densities[format == EamFormat::setfl ? second : second * elements + first];
      params.pairs[a * n + b] = file.pairs[more * (more + 1) / 2 + less];
    }
  }
  return params;
}

}  // namespace dch::lammps
