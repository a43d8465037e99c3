// net_make_seed_corpus DIRECTORY: a request, a reply and a packet of each kind, for the fuzzers to start from.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "net/control.h"
#include "net/packet.h"

namespace {

void write_file(const std::filesystem::path& path, const fb::Bytes& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

int main(int argc, char** argv) {
  using namespace fb::net;
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s DIRECTORY\n", argv[0]);
    return 2;
  }
  const std::filesystem::path root = argv[1];
  std::vector<fb::Bytes> datagrams;
  for (const ControlRequest& request :
       {ControlRequest(ccreq::Connect{}), ControlRequest(ccreq::ServerInfo{}), ControlRequest(ccreq::PlayerInfo{}),
        ControlRequest(ccreq::RuleInfo{}), ControlRequest(ccreq::RuleInfo{"sv_gravity"})})
    datagrams.push_back(write_control(request));
  for (const ControlReply& reply :
       {ControlReply(ccrep::Accept{40001}), ControlReply(ccrep::Reject{"Server is full.\n"}),
        ControlReply(ccrep::ServerInfo{"", "name", "map", 1, 4, 3}),
        ControlReply(ccrep::PlayerInfo{0, "player", 1, 2, 3, ""}), ControlReply(ccrep::RuleInfo{"sv_gravity", "800"})})
    datagrams.push_back(write_control(reply));
  const fb::Bytes payload = {1, 2, 3};
  for (const PacketKind kind : {PacketKind::kData, PacketKind::kAck, PacketKind::kNak, PacketKind::kUnreliable})
    datagrams.push_back(write_packet({kind, kind == PacketKind::kData, 0, payload}));
  fb::Bytes all;
  for (std::size_t i = 0; i < datagrams.size(); ++i) {
    write_file(root / "fuzz_packet" / std::to_string(i), datagrams[i]);
    for (std::uint8_t where = 0; where < 4; ++where) {
      all.push_back(where);
      all.push_back(static_cast<std::uint8_t>(datagrams[i].size()));
      all.insert(all.end(), datagrams[i].begin(), datagrams[i].end());
    }
  }
  write_file(root / "fuzz_transport" / "all", all);
  return 0;
}
