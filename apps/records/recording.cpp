// The rows of a recording, and what each measured.

#include "records/recording.hpp"

#include <cmath>

namespace sigmax::apps {
namespace {

/// No measurement of this world, in m or degrees, but what a device writes where it has none.
constexpr double beyond_sense = 1e30;

}  // namespace

bool RecordingReader::next(Row& row) {
  const auto is_selected = [&](const auto& wanted) { return trimmed(row_[wanted.first]) == wanted.second; };
  do {
    if (!csv_.next(row_)) return false;
  } while (!std::ranges::all_of(select_, is_selected) || !take_time(row));
  row.roll_deg = roll_ ? number_in(*roll_) : std::nullopt;
  if (sensor_ && row.sensor.empty()) throw row_.error(*sensor_, "the name of the row's sensor", "fill the cell");
  take_numbers();
  row.truth = position(Role::truth);
  row.rates = rates();
  const double time = row.detection.time;
  row.sensor_at = position(Role::sensor_position);
  row.sensor_place = has_value(Role::sensor_place) ? std::optional(place(Role::sensor_place)) : std::nullopt;
  ++rows_;
  row.detection = measured();
  row.detection.time = time;
  return true;
}

/// The number in a cell, which may stand for none.
std::optional<double> RecordingReader::number_in(std::size_t column) {
  const std::string_view cell = trimmed(row_[column]);
  const auto is_cell = [&](const std::string& word) {
    const auto number = parse_number(word);
    return cell == word || (number && number == parse_number(cell));
  };
  if (cell.empty() || std::ranges::none_of(options_.missing, is_cell)) {
    // A digit may follow a sign; 1 234, 1.234,5 and 33.88°S are no words for nothing.
    if (!cell.empty() && !parse_number(cell) && cell.find_first_of("0123456789") > 1)
      throw row_.error(column, "a finite number with a decimal point",
                       "leave the cell empty where there is none, or name such cells by --missing=" + typed(cell));
    return row_.optional_number(column);
  }
  ++missing_cells_[column];
  return std::nullopt;
}

/// What the row says of each quantity.
void RecordingReader::take_numbers() {
  for (std::size_t q = 0; q < quantities.size(); ++q)
    values_[q] = columns_[q] ? number_in(columns_[q]->index) : std::nullopt;
  // A longitude of 181° may be 179° west; it is none beside a latitude that is none, and so is an altitude.
  const auto is_not_available = [&](std::size_t q) { return values_[q] && values_[q] == columns_[q]->not_available; };
  const bool no_place = is_not_available(place_of(Role::place)) && is_not_available(place_of(Role::place) + 1);
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const Role role = quantities[q].role;
    if (is_not_available(q) && (role != Role::place || no_place)) ++missing_cells_[columns_[q]->index];
    if (role == Role::place ? no_place : is_not_available(q)) values_[q].reset();
    if (values_[q] && std::abs(*values_[q]) >= beyond_sense) {
      ++missing_cells_[columns_[q]->index];
      std::fill_n(values_.begin() + place_of(role), size_of(role), std::nullopt);
    }
    if (values_[q]) *values_[q] *= columns_[q]->unit->value;
    if (values_[q] && from_zenith_ && q == place_of(Role::polar) + 2) values_[q] = 90.0 - *values_[q];
    if (values_[q] && is_accuracy(role) && role != Role::covariance && !(*values_[q] > 0.0))
      throw row_.error(columns_[q]->index, "a positive standard deviation", "leave the cell empty where it is unknown");
  }
  // A coordinate whose accuracy --missing names was not measured.
  for (std::size_t i = 0; i < 3; ++i)
    for (const std::size_t q :
         {place_of(Role::sigma_position) + i, place_of(Role::covariance) + covariances(i + 1) - 1})
      if (columns_[q] && !values_[q] && !trimmed(row_[columns_[q]->index]).empty())
        values_[place_of(where()) + i].reset();
}

std::optional<double> RecordingReader::written(std::size_t quantity) const {
  const Column& column = *held(quantity);
  const auto number = parse_number(row_[column.index]);
  const auto is_it = [&](const auto& word) { return parse_number(word) == number; };
  return number == column.not_available || std::ranges::any_of(options_.missing, is_it) ? std::nullopt : number;
}

/// What columns tell of the velocity that do not count.
Position RecordingReader::rates() const {
  const auto ignored = [&](Role role, std::size_t i) {
    const auto& column = doubted_[place_of(role) + i];
    const auto number = column ? written(place_of(role) + i) : std::nullopt;
    return number && std::abs(*number) < beyond_sense ? *number * column->unit->value : nan;
  };
  Position rates = {ignored(Role::velocity, 0), ignored(Role::velocity, 1), ignored(Role::velocity, 2)};
  const double speed = ignored(Role::course, 0), course = ignored(Role::course, 1) * degree;
  if (std::isnan(rates[0]) && axes_ > 1 && speed >= 0.0) {
    rates[0] = speed * std::sin(course);
    rates[1] = speed * std::cos(course);
  }
  return rates;
}

/// Whether it has a number.
bool RecordingReader::has_value(Role role) const {
  const auto first = values_.begin() + place_of(role);
  return std::any_of(first, first + size_of(role), [](const auto& number) { return number.has_value(); });
}

InputError RecordingReader::error(Role role, std::size_t i, std::string_view expected, std::string_view remedy) const {
  return row_.error(columns_[place_of(role) + i]->index, expected, remedy);
}

void RecordingReader::require_whole(Role role, std::size_t size) const {
  for (std::size_t i = 0; i < size; ++i)
    if (has(role, i) && !value(role, i))
      throw error(role, i, "a number, since the row's other coordinates are there", "fill the cell or empty them all");
}

/// The position that it says, if it does.
std::optional<Position> RecordingReader::position(Role role) const {
  if (!has_value(role)) return std::nullopt;
  require_whole(role, 3);
  return Position{*value(role), value(role, 1).value_or(0.0), value(role, 2).value_or(0.0)};
}

/// The place on the Earth that it says, perhaps without an altitude.
Geodetic RecordingReader::place(Role role) const {
  require_whole(role, 2);
  const Geodetic place{*value(role), *value(role, 1), value(role, 2).value_or(0.0)};
  if (place.is_valid()) return place;
  const double latitude = std::abs(place.latitude_deg), longitude = std::abs(place.longitude_deg);
  const bool is_latitude = latitude > 90.0;
  throw error(role, is_latitude ? 0 : 1, is_latitude ? "degrees from −90 to 90" : "degrees from −360 to 360",
              is_latitude && role == Role::place && latitude <= 360.0 && longitude <= 90.0
                  ? fmt::format("correct the cell, or, where latitude and longitude are exchanged, give --columns "
                                "latitude_{0}={1},longitude_{2}={3}",
                                columns_[place_of(role)]->unit->suffix, typed(header_of(place_of(role) + 1)),
                                columns_[place_of(role) + 1]->unit->suffix, typed(header_of(place_of(role))))
              : std::max(latitude, longitude) < 1000.0
                  ? "correct the cell or drop the row"
                  : "if all are so, they are no degrees, but degrees and minutes in a row, as 5359.4, minutes, degrees "
                    "× 10⁷ or semicircles × 2³¹: write degrees");
}

/// What the row measured.
AnyDetection RecordingReader::measured() {
  const bool is_located = has_value(where()), is_moving = has_value(Role::velocity) || has_value(Role::course);
  const bool is_seen = has_value(Role::polar) && (polar() || !is_located);
  if (is_located && is_seen)
    throw error(Role::polar, 0, "an empty cell, since the row has a position", "give each sensor a row of its own");
  if (!is_seen) return components();
  if (is_moving) ++unused_velocities_;
  return radar_detection();
}

AnyDetection RecordingReader::radar_detection() const {
  const bool is_bearing = !value(Role::polar, 0) && !value(Role::polar, 2);
  if (!is_bearing) require_whole(Role::polar, 2);  // in space it may have no elevation
  if (!is_bearing && !(*value(Role::polar) > 0.0))
    throw error(Role::polar, 0, "a range above 0 m", "correct the cell, or empty the cells of a missed measurement");
  if (!(std::abs(value(Role::polar, 2).value_or(0.0)) <= 90.0))
    throw error(Role::polar, 2, from_zenith_ ? "degrees from 0 to 180" : "degrees from −90 to 90",
                "correct the cell; if all are gon or mils, write degrees");
  const double azimuth = *value(Role::polar, 1);
  if (!(std::abs(azimuth) <= 360.0))
    throw error(Role::polar, 1, "degrees from −360 to 360", "correct the cell; if all are gon or mils, write degrees");
  const double from_east = (azimuth_from_ == AzimuthFrom::north   ? 90.0 - azimuth
                            : azimuth_from_ == AzimuthFrom::ahead ? -azimuth
                                                                  : azimuth) *
                           degree;
  const double sigma_azimuth = value(Role::sigma_polar, 1).value_or(nan) * degree;
  if (is_bearing) return AnyDetection::bearing(0.0, radians(from_east), radians(sigma_azimuth));
  const double sigma_range = value(Role::sigma_polar).value_or(nan);
  std::vector<double> z = {*value(Role::polar), from_east};
  std::vector<double> variances = {sigma_range * sigma_range, sigma_azimuth * sigma_azimuth};
  if (value(Role::polar, 2)) {
    const double sigma_elevation = value(Role::sigma_polar, 2).value_or(nan) * degree;
    z.push_back(*value(Role::polar, 2) * degree);
    variances.push_back(sigma_elevation * sigma_elevation);
  }
  if (!value(Role::range_rate) || z.size() < static_cast<std::size_t>(axes_))
    return AnyDetection::polar(0.0, z, variances);
  z.push_back(*value(Role::range_rate));
  variances.push_back(nan);
  return AnyDetection::doppler(0.0, z, variances);
}

/// The position, as far as the row has it, and the velocity; or that nothing was measured.
AnyDetection RecordingReader::components() const {
  // A place has a latitude and a longitude; another position may lack any coordinate.
  if (geodetic() && (value(Role::place) || value(Role::place, 1))) place(Role::place);
  std::vector<int> places;
  std::vector<double> z, variances;
  const auto add = [&](std::size_t place, double number, double sigma) {
    places.push_back(static_cast<int>(place));
    z.push_back(number);
    variances.push_back(sigma * sigma);
  };
  const double sigma = value(Role::sigma_all_axes).value_or(nan);
  for (std::size_t i = 0; i < 3; ++i)
    if (value(where(), i)) add(i, *value(where(), i), value(Role::sigma_position, i).value_or(sigma));
  const auto axes = static_cast<std::size_t>(axes_);
  if (const auto speed = value(Role::course), course = value(Role::course, 1); speed && course) {
    if (!(std::abs(*course) <= 360.0)) throw error(Role::course, 1, "degrees from −360 to 360", "correct the cell");
    add(axes, *speed * std::sin(*course * degree), nan);
    add(axes + 1, *speed * std::cos(*course * degree), nan);
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (value(Role::velocity, i)) add(axes + i, *value(Role::velocity, i), nan);
  return z.empty() ? AnyDetection{} : AnyDetection::components(0.0, places, z, covariance(places, variances));
}

/// The covariance of components at these places of the state, row by row, by their variances where the row tells none.
std::vector<double> RecordingReader::covariance(const std::vector<int>& places, std::vector<double> variances) const {
  const std::size_t n = places.size();
  const auto number = [&](std::size_t i, std::size_t j) {  // of those that the row may tell, j up to i
    return covariances(static_cast<std::size_t>(places[i])) + static_cast<std::size_t>(places[j]);
  };
  const auto own = [&](std::size_t i, std::size_t j) {
    return places[i] < axes_ ? value(Role::covariance, number(i, j)) : std::nullopt;
  };
  std::vector<double> matrix(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    matrix[i * (n + 1)] = variances[i] = own(i, i).value_or(variances[i]);
    for (std::size_t j = 0; j < i; ++j) {
      if (own(i, j) && std::isnan(variances[i] + variances[j]))
        throw error(Role::covariance, number(i, j), "an empty cell, since the row does not have both variances",
                    "fill theirs");
      matrix[i * n + j] = matrix[j * n + i] = own(i, j).value_or(0.0);
    }
  }
  std::vector<double> left = matrix;  // by elimination
  for (std::size_t k = 0; k < n; ++k) {
    const double pivot = left[k * (n + 1)];
    if (std::isnan(pivot)) continue;  // the settings' variance, of an error that depends on no other
    if (pivot <= 0.0) {
      std::size_t at = number(k, k);
      while (!has(Role::covariance, at)) --at;
      throw error(Role::covariance, at, "a positive definite covariance with those beside it",
                  "correct it, or leave the row's covariances empty");
    }
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = k + 1; j < n; ++j) left[i * n + j] -= left[i * n + k] * left[k * n + j] / pivot;
  }
  return matrix;
}

std::vector<std::string> RecordingReader::notes() const {
  const std::string columns = unused();
  const std::string times = midnights_.rows == 1 ? "once" : fmt::format("{} times", midnights_.rows);
  const std::string missing =
      list_of(missing_cells_, [&](const auto& of) { return fmt::format("{} {}", csv_.names()[of.first], of.second); });
  const std::pair<bool, std::string> notes[] = {
      {!columns.empty(), "Not used: " + columns},
      {!missing.empty(), "Cells that stand for no number: " + missing},
      {unused_velocities_ > 0,
       fmt::format("Velocities do not count in rows of a radar or with a bearing: {} rows", unused_velocities_)},
      {midnights_.rows > 0, fmt::format("Times of day pass midnight {}, first on line {}; there the time falls by more "
                                        "than 12 h, and days are counted from the first",
                                        times, midnights_.first_line)}};
  std::vector<std::string> sentences;
  for (const auto& [holds, sentence] : notes)
    if (holds) sentences.push_back(sentence);
  return sentences;
}

}  // namespace sigmax::apps
