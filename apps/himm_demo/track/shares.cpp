#include "himm_demo/track/track.hpp"

#include <nlohmann/json.hpp>

// What ranks tell each other of a row, by name.
template <class Value>
struct nlohmann::adl_serializer<std::optional<Value>> {
  static void to_json(json& message, const std::optional<Value>& value) { message = value ? json(*value) : json(); }
  static void from_json(const json& message, std::optional<Value>& value) {
    if (!message.is_null()) value = message.get<Value>();
  }
};

namespace sigmax {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TargetPoint, time, tag, mean, covariance, weights, most_likely_mode, nis,
                                   normalized_innovation)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ModeStay, since, tag, mode, is_start)
}  // namespace sigmax

namespace sigmax::apps {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Geodetic, latitude_deg, longitude_deg, altitude_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Said, filter, point, frame)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Tally, rejected, starts)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(News, said, tallies, histories, failure)

TrackShares::TrackShares() : ranks_(Ranks::join("run it without mpirun")), unheard_(1) {
  if (!ranks_) return;
  rank_ = ranks_->rank();
  unheard_.resize(static_cast<std::size_t>(ranks_->size()));
}

std::optional<News> TrackShares::by(int rank, const std::function<News()>& work) {
  if (!follows(rank)) return first() ? std::optional(heard(rank)) : std::nullopt;
  News news = work();
  if (first()) return news;
  tell(std::move(news));
  return std::nullopt;
}

void TrackShares::run(const std::function<void()>& all) {
  try {
    all();
  } catch (const std::exception& error) {
    if (alone()) throw;
    if (first()) ranks_->abort(error);
    tell({.said = {}, .tallies = {}, .histories = {}, .failure = error.what()});
    send();
  }
}

void TrackShares::finish() {
  if (first()) {
    for (int rank = 1; rank < static_cast<int>(unheard_.size()); ++rank) heard(rank);
  } else {
    tell({});
    send();
  }
}

/// What comes next of a rank, if that is no failure.
News TrackShares::heard(int rank) {
  auto& unheard = unheard_[static_cast<std::size_t>(rank)];
  if (unheard.empty())
    for (const nlohmann::json& message : nlohmann::json::from_msgpack(ranks_->hear(rank)))
      unheard.push_back(message.get<News>());
  News news = std::move(unheard.front());
  unheard.pop_front();
  if (news.failure) throw InputError(*news.failure);
  return news;
}

void TrackShares::tell(News news) {
  constexpr std::size_t enough = 32;
  untold_.push_back(std::move(news));
  if (untold_.size() >= enough) send();
}

void TrackShares::send() {
  std::string bytes;
  nlohmann::json::to_msgpack(std::exchange(untold_, {}), bytes);
  ranks_->tell(std::move(bytes));
}

}  // namespace sigmax::apps
