// How sure of itself is a converted radar measurement? Mean NEES of three conversions: 2 in the plane and 3 in space if
// its covariance is right. Argument: draws for each line.

#include <iomanip>
#include <iostream>
#include <string>

#include <sigmax/estimation/chi_square.hpp>
#include <sigmax/estimation/metrics.hpp>
#include <sigmax/estimation/radar.hpp>

#include "shell/random.hpp"

using namespace sigmax;

constexpr std::array conversions{Conversion::standard, Conversion::unbiased, Conversion::debiased};

/// NEES of a conversion of what the radar measured; without a deviation of the elevation, in the plane.
double nees_of(const Polar& measured, const Polar& sigma, const Polar& truth, Conversion conversion) {
  if (sigma.elevation.radians() > 0.0) return nees(to_cartesian(measured, sigma, conversion), to_cartesian(truth));
  return nees(to_cartesian<2>(measured, sigma, conversion), to_cartesian<2>(truth));
}

std::array<double, 3> study(const Polar& truth, const Polar& sigma, int draws) {
  apps::RandomStream noise{1, 0};
  std::array<double, 3> sum{};
  for (int i = 0; i < draws; ++i) {
    const double range = truth.range + sigma.range * noise.normal();
    const Angle azimuth = truth.azimuth + noise.normal() * sigma.azimuth;
    const Angle elevation = truth.elevation + noise.normal() * sigma.elevation;
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] += nees_of({range, azimuth, elevation}, sigma, truth, conversions[k]) / draws;
  }
  return sum;
}

int main(int argc, char** argv) {
  const int draws = argc > 1 ? std::stoi(argv[1]) : 100000;
  const Polar target = to_polar({120e3, 80e3, 20e3});
  for (const bool in_space : {false, true}) {
    const Band band = chi_square_band(in_space ? 3.0 : 2.0, draws);
    std::cout << std::fixed << std::setprecision(2) << (in_space ? "\nIn space: NEES " : "In the plane: NEES ")
              << band.lower << " to " << band.upper << " is consistent\n"
              << "  sigma   r s^2/s_r   standard   unbiased   debiased\n";
    for (const double sigma_deg : {0.1, 0.9, 1.8, 3.0}) {
      const Angle angle = degrees(sigma_deg), none;
      const Polar sigma{100.0, angle, in_space ? angle : none};
      const auto found = study({target.range, target.azimuth, in_space ? target.elevation : none}, sigma, draws);
      std::cout << std::setprecision(1) << std::setw(5) << sigma_deg << " deg" << std::setprecision(3) << std::setw(10)
                << conversion_validity(target.range, sigma) << std::setprecision(2);
      for (const double value : found) std::cout << std::setw(11) << value;
      std::cout << '\n';
    }
  }
}
