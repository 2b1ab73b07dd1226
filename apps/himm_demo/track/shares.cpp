#include "himm_demo/track/track.hpp"

#include <nlohmann/json.hpp>

namespace sigmax::apps {
namespace {

using Message = nlohmann::json;

Message packed(const News& news) {
  Message said = Message::array(), tallies = Message::array(), histories = Message::array();
  for (const auto& [filter, point, frame] : news.said)
    said.push_back({filter, point.time, point.tag, point.mean, point.covariance, point.weights, point.most_likely_mode,
                    point.nis ? Message(*point.nis) : Message(),
                    frame ? Message{frame->latitude_deg, frame->longitude_deg, frame->altitude_m} : Message()});
  for (const auto& [rejected, starts] : news.tallies) tallies.push_back({rejected, starts});
  for (const auto& stays : news.histories) {
    histories.push_back(Message::array());
    for (const auto& [since, tag, mode, is_start] : stays) histories.back().push_back({since, tag, mode, is_start});
  }
  return {said, tallies, histories, news.failure ? Message(*news.failure) : Message()};
}

News unpacked(const Message& message) {
  News news;
  for (const Message& m : message[0]) {
    auto& [filter, point, frame] = news.said.emplace_back();
    filter = m[0];
    point.time = m[1];
    point.tag = m[2];
    point.mean = m[3].get<std::vector<double>>();
    point.covariance = m[4].get<std::vector<double>>();
    point.weights = m[5].get<std::vector<double>>();
    point.most_likely_mode = m[6];
    if (!m[7].is_null()) point.nis = m[7].get<double>();
    if (!m[8].is_null()) frame = Geodetic{m[8][0], m[8][1], m[8][2]};
  }
  for (const Message& m : message[1]) news.tallies.push_back({m[0], m[1]});
  for (const Message& stays : message[2]) {
    news.histories.emplace_back();
    for (const Message& m : stays) news.histories.back().push_back({m[0], m[1], m[2], m[3]});
  }
  if (!message[3].is_null()) news.failure = message[3].get<std::string>();
  return news;
}

}  // namespace

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
    News last;
    last.failure = error.what();
    tell(std::move(last));
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
    for (const Message& message : Message::from_msgpack(ranks_->hear(rank))) unheard.push_back(unpacked(message));
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
  Message all = Message::array();
  for (const News& news : std::exchange(untold_, {})) all.push_back(packed(news));
  std::string bytes;
  Message::to_msgpack(all, bytes);
  ranks_->tell(std::move(bytes));
}

}  // namespace sigmax::apps
