// Prints the tables of Misc/docs/numerics.md: the errors of shared/vmf.h against long double, on the host and on the
// Vulkan device (VK_ICD_FILENAMES, or its name as the argument, chooses one).
#include <fmt/format.h>

#include "gpu/test_vmf_device.h"
#include "shared/test_vmf_errors.h"

namespace {

using namespace fb::shared;

// The same from the usual formulas, as float32 evaluates them: for comparison.
VmfAnswer textbook_probe(const VmfQuery& query) {
  const vec3 mu = vmf_mu(query);
  const float kappa = query.mu_kappa.w, e = std::exp(-2 * kappa), r = 1 - query.w_c.w;
  const float pdf = kappa / (2 * kVmfPi * (1 - e)) * std::exp(kappa * (dot(mu, vmf_w(query)) - 1));
  const float cosine = 1 + std::log(1 - query.u.x * (1 - e)) / kappa, sine = std::sqrt(1 - cosine * cosine);
  const float phi = (2 * query.u.y - 1) * kVmfPi;
  const reference::Vector tangent = reference::direction_about(mu, 1, 0);
  const reference::Vector bitangent = reference::direction_about(mu, 1, reference::kPi / 2);
  const vec3 w = normalize(reference::rounded(tangent) * (sine * std::cos(phi)) +
                           reference::rounded(bitangent) * (sine * std::sin(phi)) + mu * cosine);
  const float banerjee = r * (3 - r * r) / (1 - r * r);
  VmfAnswer answer = vmf_probe(query);
  answer.sample_t = vec4(w, 1 - cosine);
  answer.pdf = vec4(pdf, pdf, 1 - (1 / std::tanh(kappa) - 1 / kappa), kappa / (2 * kVmfPi * (1 - e)));
  answer.kappa.x = banerjee;
  return answer;
}
std::vector<VmfAnswer> evaluate_textbook(const std::vector<VmfQuery>& queries) {
  std::vector<VmfAnswer> answers;
  for (const VmfQuery& query : queries) answers.push_back(textbook_probe(query));
  return answers;
}

void print_tables(const std::string& machine, const VmfEvaluate& evaluate, const VmfPrecision& precision) {
  const VmfFunctionErrors own = vmf_function_errors(evaluate);
  fmt::print("{} (its exp {:.1e}, log {:.1e}, sin {:.1e}, cos {:.1e})\n\n", machine, own.exp, own.log, own.sin,
             own.cos);
  fmt::print("| kappa | pdf, kappa t <= 1 | pdf, kappa t <= 80 | integral | inverse CDF | E[1 - cos] | E[sin^2] |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const auto& [kappa, name] : kVmfTestKappas) {
    const VmfSampleErrors sample = vmf_sample_errors(evaluate, precision, kappa);
    fmt::print("| {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |\n", name,
               vmf_pdf_error(evaluate, precision, kappa, 1).error, vmf_pdf_error(evaluate, precision, kappa, 80).error,
               vmf_integral_error(evaluate, precision, kappa).error,
               vmf_inverse_cdf_error(evaluate, precision, kappa).error, sample.mean.error, sample.second.error);
  }
  fmt::print("\n| kappa | c of kappa | vmf_kappa | vmf_kappa_fit | vmf_kappa_newton | half a spacing of c |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- |\n");
  for (std::size_t i = 0; i + 1 < kVmfTestRanges.size(); ++i) {
    const auto& [low, low_name] = kVmfTestRanges[i];
    const auto& [high, high_name] = kVmfTestRanges[i + 1];
    const VmfInversionErrors errors = vmf_inversion_errors(evaluate, precision, low, high);
    fmt::print("| {} to {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |\n", low_name, high_name,
               errors.complement.error, errors.kappa[0].error, errors.kappa[1].error, errors.kappa[2].error,
               errors.condition * kRoundoff);
  }
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  print_tables("Host", vmf_evaluate_on_host, kVmfHostPrecision);
  print_tables("Host, by the textbook's formulas", evaluate_textbook, kVmfHostPrecision);
  fb::gpu::DeviceOptions options;
  if (argc > 1) options.preferred = argv[1];
  auto device = fb::gpu::Device::create(options);
  if (!device) {
    fmt::print("No Vulkan device: {}\n", device.error().message);
    return 1;
  }
  fb::gpu::VmfDevice evaluate(**device);
  print_tables((*device)->report().name, std::ref(evaluate), kVmfVulkanPrecision);
}
