// Everything that shared/vmf.h computes, for one query: the tests and the table of Misc/docs/numerics.md call this on
// the host and, through Shaders/tests/vmf.comp, on the device.
#ifndef FB_SHARED_TEST_VMF_PROBE_H
#define FB_SHARED_TEST_VMF_PROBE_H
#include "shared/vmf.h"
FB_NAMESPACE_BEGIN

struct VmfQuery {
  vec4 mu_kappa;
  vec4 w_c;  // a direction to evaluate; 1 - mean cosine to invert
  vec4 u;    // two random numbers to sample with; x of exp(-x); x of log(x)
};
struct VmfAnswer {
  vec4 sample_t;   // vmf_sample; vmf_inverse_cdf
  vec4 pdf;        // vmf_pdf; vmf_lobe_pdf; vmf_mean_cosine_complement; vmf_normalization
  vec4 kappa;      // from c: vmf_kappa, vmf_kappa_fit, vmf_kappa_newton
  vec4 functions;  // the machine's own: exp(-u.z), log(u.w), and sin and cos of (2 u.y - 1) pi
};

FB_FN VmfAnswer vmf_probe(VmfQuery query) {
  vec3 mu = vec3(query.mu_kappa.x, query.mu_kappa.y, query.mu_kappa.z);
  vec3 w = vec3(query.w_c.x, query.w_c.y, query.w_c.z);
  float kappa = query.mu_kappa.w, c = query.w_c.w;
  vec3 drawn = vmf_sample(mu, kappa, vec2(query.u.x, query.u.y));
  VmfAnswer answer;
  answer.sample_t = vec4(drawn, vmf_inverse_cdf(kappa, query.u.x));
  answer.pdf = vec4(vmf_pdf(mu, kappa, w), vmf_lobe_pdf(vmf_lobe(mu, kappa), w), vmf_mean_cosine_complement(kappa),
                    vmf_normalization(kappa));
  answer.kappa = vec4(vmf_kappa(c), vmf_kappa_fit(c), vmf_kappa_newton(c), 0.0f);
  float phi = (2.0f * query.u.y - 1.0f) * kVmfPi;
  answer.functions = vec4(exp(-query.u.z), log(query.u.w), sin(phi), cos(phi));
  return answer;
}

FB_NAMESPACE_END
#endif
