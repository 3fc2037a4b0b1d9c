/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The numbers that certificates describe [CERT-10]: each operation against libm, by a narrow rectangle that holds the
 * value and is accepted, and by those beside it, which are not; what is not defined, beyond the limits or misspelled is
 * refused. All of them with every allocation failing once, too. */
#include "checker/exhaust.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>
#include <gmp.h>
#include <math.h>
#include <stdlib.h>

enum { SIZE = 1 << 18 };

/* Each after the number 0 = 0, one a line: the last one is meant. */
typedef struct number_case {
  const char *lines;
  double value;
} number_case;

#define TURN 6.28318530717958647692
static const number_case of_known_value[] = {
    {"= 7", 7},
    {"= -9/4", -2.25},
    {"= 1\n= 2\n+ 1 2", 3},
    /* roots */
    {"= 2\nsqrt 1", 1.41421356237309504880},
    {"= 9/4\nsqrt 1", 1.5},
    {"sqrt 0", 0},
    {"cbrt 0", 0},
    {"= -8\ncbrt 1", -2},
    {"= 2\nsqrt 1\n^ 2 2\n- 3 1\nsqrt 4", 0},
    {"= 8\n= 2\nsqrt 2\nsqrt 1 2*x0", 2.82842712474619009760},
    {"= 4\nsqrt 1 2", 2},
    {"sqrt 0 0", 0},
    {"cbrt 0 0", 0},
    {"= -8\ncbrt 1 -2", -2},
    {"root 1 2 -2,0,1", 1.41421356237309504880},
    {"root 1 2 -2,0,1\nroot 1/2 3 -2,0,1 x0", 1.41421356237309504880},
    {"root -2 -1 -2,0,1", -1.41421356237309504880},
    {"root 1 2 -2,0,1\nroot -5/2 -1 -2,0,1 -x0", -1.41421356237309504880},
    {"root 1 3 -4,0,1", 2},
    {"root 1 3 -4,0,1 2", 2},
    {"root 1/3 2 -3,0,2", 1.22474487139158904910},
    {"root 2 3 -5,-2,0,1", 2.09455148154232659148},
    /* arithmetic; a divisor that is 0 at low precision; what reaches over a power of two at the limit of size */
    {"= 2\nsqrt 1\n= 3\n+ 2 3", 4.41421356237309504880},
    {"= 2\nsqrt 1\n= 3\n- 3 2", 1.58578643762690495120},
    {"= 2\nsqrt 1\n= 3\n* 3 2", 4.24264068711928514641},
    {"= 2\nsqrt 1\n= 3\n/ 3 2", 2.12132034355964257320},
    {"= 1\n= 1/1606938044258990275541962092341162602522202993782792835301376\n/ 1 2", 0x1p200},
    {"= 2\nsqrt 1\n^ 2 5", 5.65685424949238019521},
    {"= 2\nsqrt 1\n^ 2 -3", 0.35355339059327376220},
    {"^ 0 0", 1},
    {"= 1\nexp 1\n^ 2 -1", 0.36787944117144232160},
    {"= -2\n^ 1 -3", -0.125},
    {"= 5\nclaim 1", 5},
    {"= 5\nneg 1", -5},
    {"= 2\nsqrt 1\nneg 2", -1.41421356237309504880},
    {"abs 0", 0},
    {"= 5\nabs 1", 5},
    {"= -5\nabs 1", 5},
    {"= 2\nsqrt 1\nneg 2\nabs 3", 1.41421356237309504880},
    {"= 2\nsqrt 1\n^ 2 2\n- 3 1\nabs 4", 0},
    {"= 2\nsqrt 1\n^ 2 2\n- 1 3\nabs 4", 0},
    {"= 3\nsqrt 1\n^ 2 2\n- 3 1\nabs 4", 0},
    {"= 3\nsqrt 1\n^ 2 2\n- 1 3\nabs 4", 0},
    {"= 2\nsqrt 1\n= 1\nmin 2 3", 1},
    {"= 2\nsqrt 1\n= 1\nmax 2 3", 1.41421356237309504880},
    {"= 2\nsqrt 1\n= 1\nmin 3 2", 1},
    {"= 2\nsqrt 1\n= 1\nmax 3 2", 1.41421356237309504880},
    {"= 6\nmin 1 1", 6},
    {"= 6\nmax 1 1", 6},
    /* angles: any; of equal and of opposite ones; parts of a turn */
    {"= 1\ncos 1", 0.54030230586813971740},
    {"= 1\nsin 1", 0.84147098480789650665},
    {"= 1\ntan 1", 1.55740772465490223051},
    {"= 1\ncos 1\nsin 1\ntan 1", 1.55740772465490223051},
    {"= 1\nsin 1\nneg 1\nsin 3", -0.84147098480789650665},
    {"= 1\nsin 1\nneg 1\ncos 3", 0.54030230586813971740},
    {"= 1\nsin 1\nneg 1\ntan 3", -1.55740772465490223051},
    {"= 16777215\ncos 1", -0.31757645973239707},
    {"= 1\ncos 1\ncos 2", 0.85755321584639341574},
    {"= 2\nsqrt 1\ncos 2", 0.15594369476537447346},
    {"pi\n= x0^2\ncos 2", -0.90268536193307106616},
    {"pi\n= x0+1\nsin 2", -0.84147098480789650665},
    {"pi\ne\n/ 1 2\ncos 3", 0.40325305140849882},
    {"pi\ne\n* 1 2\nsin 3", 0.77394268526670902},
    {"pi\npi\n- 1 2\ncos 3", 1},
    {"pi\n= 2*x0\ncos 2", 1},
    {"cos 0", 1},
    {"cycle 4\nsin 0", 0},
    {"pi", TURN / 2},
    {"cycle 12\npi\n= x1/6\ncos 3", 0.86602540378443864676},
    {"cycle 12\npi\n= x1/6\nsin 3", 0.5},
    {"cycle 12\npi\n= x1/6\ntan 3", 0.57735026918962576451},
    {"cycle 12\npi\n= -25*x1/6\nsin 3", -0.5},
    {"cycle 7\npi\n= 6*x1/7\ncos 3", -0.90096886790241912624},
    {"cycle 1", 2},
    {"cycle 2", -2},
    {"cycle 3", -1},
    {"cycle 4", 0},
    {"cycle 5", 0.61803398874989484820},
    {"cycle 12", 1.73205080756887729353},
    {"cycle 105", 1.99642025953547030},
    {"cycle 1\npi\n= 4*x1\ncos 3", 1},
    /* exponentials: one and the same leaf, and its inverse */
    {"exp 0", 1},
    {"e", 2.71828182845904523536},
    {"= 1\nexp 1", 2.71828182845904523536},
    {"= 1\nexp 1\ne\n- 2 3", 0},
    {"e\n= 1\nexp 2", 2.71828182845904523536},
    {"e\n= -1\nexp 2", 0.36787944117144232160},
    {"= 200\nexp 1", 7.2259737681257492581e86},
    {"= 1/3\nexp 1", 1.39561242508608952863},
    {"= 1\nexp 1\nsinh 1", 1.17520119364380145688},
    {"= 1\nexp 1\ncosh 1", 1.54308063481524377848},
    {"= 1\nexp 1\ntanh 1", 0.76159415595576488812},
    {"= -1\nexp 1\nneg 1\nsinh 3", 1.17520119364380145688},
    /* logarithms: of 1, large and small ones, of what is positive at a precision that is high, of another one */
    {"= 3\nlog 1", 1.09861228866810969140},
    {"= 1\nlog 1", 0},
    {"= 1/7\nlog 1", -1.94591014905531330511},
    {"= 3\nlog 1\nlog 2", 0.09404782761669912},
    {"= 2\n^ 1 200\nlog 2", 138.629436111989061883},
    {"= 2\n^ 1 -200\nlog 2", -138.629436111989061883},
    {"= 2\n^ 1 4096\n^ 2 4\nlog 3", 11356.5234062941439},
    {"= 2\n^ 1 -4000\nlog 2", -2772.58872223978124},
    {"= 2\nsqrt 1\nlog 2", 0.34657359027997265471},
    {"= 3\nlog 1\n= 3\nlog 3", 1.09861228866810969140},
    /* inverse tangents: on either side of -1, 0, 1, large ones; the opposite of one before, which is another leaf */
    {"= 1\natan 1", 0.78539816339744830962},
    {"= -1\natan 1", -0.78539816339744830962},
    {"atan 0", 0},
    {"= 1/9\natan 1", 0.11065722117389564},
    {"= 7/5\natan 1", 0.95054684081207514789},
    {"= -3\natan 1", -1.24904577239825442582},
    {"= 1152921504606846976\natan 1", 1.57079632679489661836},
    {"= -2\n^ 1 4095\n^ 2 3\natan 3", -1.57079632679489661923},
    {"= 3\natan 1\nneg 1\natan 3\natan 3\n+ 2 4", 0},
    {"= 2\nsqrt 1\natan 2", 0.95531661812450927816},
    /* inverse sines and cosines, at the ends too, which may not be seen to be these; next to them */
    {"= 1\nasin 1", 1.57079632679489661923},
    {"= -1\nasin 1", -1.57079632679489661923},
    {"= 1\nacos 1", 0},
    {"= -1\nacos 1", 3.14159265358979323846},
    {"= 2\nsqrt 1\n^ 2 2\n/ 3 1\nasin 4", 1.57079632679489661923},
    {"= 2\nsqrt 1\n* 2 2\n/ 3 1\nneg 4\nacos 5", 3.14159265358979323846},
    {"asin 0", 0},
    {"acos 0", 1.57079632679489661923},
    {"= 1/3\nasin 1", 0.33983690945412193710},
    {"= -1/3\nacos 1", 1.91063323624901855633},
    {"= 1/3\nacos 1\nneg 1\nacos 3", 1.91063323624901855633},
    {"= 2\n^ 1 -200\n= 1\n- 3 2\nasin 4", 1.57079632679489661923},
    {"= 2\n^ 1 -20\n= 1\n- 2 3\nacos 4", 3.14021158554803},
    {"= 999/1000\nacos 1", 0.04472508716873345}};

/* These are exactly so: the side is that number. */
static const char *const of_exact_value[][2] = {{"= 3\nlog 1\nlog 1\n- 2 3", "0"},
                                                {"= 1/2\nasin 1\nasin 1\n- 2 3", "0"},
                                                {"= 1/2\nacos 1\nacos 1\n- 2 3", "0"},
                                                {"= 3\natan 1\natan 1\n- 2 3", "0"},
                                                {"callback\natan 1\natan 1\n- 2 3", "0"},
                                                {"= 3\natan 1\nneg 1\natan 3\natan 3\n- 4 5", "0"},
                                                {"callback\n- 1 1", "0"},
                                                {"= 1\ncos 1\nsin 1\nmax 2 3\n- 4 3", "0"},
                                                {"callback\nclaim 1\n- 2 1", "0"},
                                                {"callback\n* 1 0", "0"},
                                                {"= 1/3", "1/3"},
                                                {"= -4/3", "-1*2^2/3"},
                                                {"= 1/32", "1*2^-5"},
                                                {"= 32", "1*2^5"},
                                                {"= 5/96", "5*2^-5/3"},
                                                /* no identity, but smaller than what is not 0 */
                                                {"= 2\nsqrt 1\n= 3\nsqrt 3\n* 2 4\n= 6\nsqrt 6\n- 5 7", "0"},
                                                {"= 2\nsqrt 1\nroot 1 2 -2,0,1\n- 2 3", "0"}};

#define NOT_THERE "the point described is not seen to lie in the rectangle of site 0"
#define NOT_DEFINED "the number is not seen to be defined, or beyond the limits"
#define NOT_SO "the number is not seen to be what the line says"
/* lines, side, why */
static const char *const refused[][3] = {
    {"= 3\nlog 1", "1*2^0", "\"1*2^0\" is not a number m or m*2^e"},
    {"= 3\nlog 1", "2+1", NOT_THERE},
    {"callback\natan 1", "0+1", NOT_THERE},
    {"= 1/3\natan 1\nneg 1\natan 3\n- 2 4", "0", NOT_THERE},
    {"= 1/3\nasin 1\nneg 1\nasin 3\n- 2 4", "0", NOT_THERE},
    {"= 1/3\nasin 1\nacos 1\n- 2 3", "0", NOT_THERE},
    {"callback", "0+1", NOT_THERE},
    {"callback\n= 1\n+ 2 1", "0+1", NOT_THERE},
    {"callback\n= 1\n- 1 2", "0+1", NOT_THERE},
    {"= 1073741824\ncos 1", "0+1", NOT_THERE},
    {"= 1073741824\ntan 1", "0+1", NOT_DEFINED},
    {"= 1000\nexp 1", "0+1", NOT_THERE},
    {"= 1000\nexp 1\nsinh 1", "0+1", NOT_THERE},
    {"= 200\nexp 1\n^ 2 150", "0+1", NOT_THERE},
    {"= 2\nsqrt 1\n^ 2 4096\n^ 3 16", "0+1", NOT_THERE},
    {"= 2\n= -3\n^ 2 4096\n^ 3 16", "0+1", NOT_THERE},
    {"= 1", "2", NOT_THERE},
    {"= 1", "1*2^300000", NOT_THERE},
    {"= 1", "1*2^-300000", NOT_THERE},
    {"e", "1", NOT_THERE},
    /* 0, and not seen to be it: too many conjugates, too large ones */
    {"= 2\nsqrt 1\n= 3\nsqrt 3\n* 2 4\n= 6\nsqrt 6\n- 5 7\nroot 1 2 -2,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1\nroot 1 2 "
     "-3,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1\nroot 1 2 -5,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1\n* 9 10\n* 12 11\n* 13 8",
     "0", NOT_THERE},
    {"= 2\nsqrt 1\n= 3\nsqrt 3\n* 2 4\n= 6\nsqrt 6\n- 5 7\n= 2\n^ 9 4096\n* 10 8", "0", NOT_THERE},
    /* not defined, or not seen to be */
    {"= 1\n/ 1 0", "0", NOT_DEFINED},
    {"^ 0 -1", "0", NOT_DEFINED},
    {"= -1\nsqrt 1", "0", NOT_DEFINED},
    {"callback\nsqrt 1", "0", NOT_DEFINED},
    {"callback\nabs 1", "0", NOT_DEFINED},
    {"callback\nmin 1 0", "0", NOT_DEFINED},
    {"callback\ntan 1", "0", NOT_DEFINED},
    {"= 1\nsinh 1", "0", NOT_DEFINED},
    {"= 1\ncosh 1", "0", NOT_DEFINED},
    {"= 1\ntanh 1", "0", NOT_DEFINED},
    {"= 3\nlog 1\nneg 1\nlog 3", "0", NOT_DEFINED},
    {"log 0", "0", NOT_DEFINED},
    {"= -3\nlog 1\n- 2 2", "0", NOT_DEFINED},
    {"callback\nlog 1", "0", NOT_DEFINED},
    {"= 2\n^ 1 -4096\n^ 2 2\nlog 3", "0", NOT_DEFINED},
    {"= 2\nsqrt 1\n^ 2 2\n- 3 1\nlog 4", "0", NOT_DEFINED},
    {"callback\nasin 1", "0", NOT_DEFINED},
    {"callback\nacos 1", "0", NOT_DEFINED},
    {"= 2\nasin 1", "0", NOT_DEFINED},
    {"= -3/2\nacos 1", "0", NOT_DEFINED},
    {"= 2\n^ 1 -200\n= 1\n+ 2 3\nasin 4\n- 5 5", "0", NOT_DEFINED},
    {"= 2\n^ 1 -200\n= -1\n- 3 2\nacos 4\n- 5 5", "0", NOT_DEFINED},
    {"cycle 5\ncycle 5", "0", NOT_DEFINED},
    {"cycle 0", "0", NOT_DEFINED},
    {"cycle 1025", "0", NOT_DEFINED},
    {"cycle -3", "0", NOT_DEFINED},
    {"pi\ncos 1", "0", NOT_DEFINED},
    {"pi\n= 2*x0\nsin 2", "0", NOT_DEFINED},
    {"cycle 4\npi\n= x1/2\ntan 3", "0", NOT_DEFINED},
    /* beyond the limits: bits, terms, exponents */
    {"= 2\n^ 1 4096\n^ 2 4096", "0", NOT_DEFINED},
    {"callback\ncallback\n= x0+1\n= x1+1\n^ 3 200\n^ 4 100\n* 5 6", "0", NOT_DEFINED},
    {"callback\n= x0^4096\n* 2 2", "0", NOT_DEFINED},
    {"callback\n= x0^4096\ncbrt 2\n= x0^4096*x1^8", "0",
     "\"x0^4096*x1^8\" is no quotient of polynomials in leaves before"},
    {"= 1\n^ 1 4097", "0", "4097 is too large"},
    {"= 1\n^ 1 -4097", "0", "-4097 is too large"},
    /* what is stated is not so */
    {"= 4\nsqrt 1 -2", "0", NOT_SO},
    {"= 4\nsqrt 1 3", "0", NOT_SO},
    {"= 8\ncbrt 1 -2", "0", NOT_SO},
    {"root 1 2 -2,0,1\nroot 1 2 -2,0,1 -x0", "0", NOT_SO},
    {"root 1 2 -2,0,1\nroot -2 -1 -2,0,1 x0", "0", NOT_SO},
    {"root 1 2 -2,0,1\nroot 1 2 -2,0,1 x0+1", "0", NOT_SO},
    {"callback\n= x0^2\nsqrt 2 x0", "0", NOT_SO},
    {"callback\n= x0^4096\nsqrt 2 x0^2049", "0", NOT_SO},
    {"callback\nroot 1 5 -7,0,1 x0^4096", "0", NOT_SO},
    {"= 5/0", "0", "a denominator is not seen not to be 0"},
    {"= 0/0", "0", "a denominator is not seen not to be 0"},
    {"callback\n= 1/x0", "0", "a denominator is not seen not to be 0"},
    {"callback\ncallback\n= 1/x0*x1", "0", "a denominator is not seen not to be 0"},
    {"= 2\nsqrt 1\n= 1/x0^2-2", "0", "a denominator is not seen not to be 0"},
    /* brackets */
    {"root 2 1 -2,0,1", "0", "the bracket is not seen to hold one root of the polynomial"},
    {"root 1 1 -2,0,1", "0", "the bracket is not seen to hold one root of the polynomial"},
    {"root 2 3 -2,0,1", "0", "the bracket is not seen to hold one root of the polynomial"},
    {"root 2 3 -4,0,1", "0", "the bracket is not seen to hold one root of the polynomial"},
    {"root 0 2 -1,3,-3,1", "0", "the bracket is not seen to hold one root of the polynomial"},
    {"root 1/1 2 -2,0,1", "0", "\"1\" is no end of a bracket, or no polynomial"},
    {"root 2/4 2 -2,0,1", "0", "\"2\" is no end of a bracket, or no polynomial"},
    {"root 1/-2 2 -2,0,1", "0", "\"1\" is no end of a bracket, or no polynomial"},
    {"root 1/y 2 -2,0,1", "0", "\"1\" is no end of a bracket, or no polynomial"},
    {"root y 2 -2,0,1", "0", "\"y\" is no end of a bracket, or no polynomial"},
    {"root 1 02 -2,0,1", "0", "\"02\" is no end of a bracket, or no polynomial"},
    {"root 1 2 2", "0", "\"2\" is no end of a bracket, or no polynomial"},
    {"root 1 2 -2,0,-1", "0", "\"-2\" is no end of a bracket, or no polynomial"},
    {"root 1 2 -2,0,0", "0", "\"-2\" is no end of a bracket, or no polynomial"},
    {"root 1 2 -2,,1", "0", "\"-2\" is no end of a bracket, or no polynomial"},
    {"root 1 2", "0", "the line is too short"},
    {"root 1 2 -2,0,1 ", "0", "two blanks, or a blank at the end or the beginning"},
    /* lines */
    {"y", "0", "\"y\" is no operation"},
    {"neg", "0", "the line is too short"},
    {"neg 1", "0", "1 is too large"},
    {"+ 0", "0", "the line is too short"},
    {"+ 0 y", "0", "\"y\" is not a number of a site or of lines"},
    {"^ 0 y", "0", "\"y\" is no integer"},
    {"pi 0", "0", "the line goes on with \"0\""},
    {"=", "0", "the line is too short"},
    {"= 1 2", "0", "the line goes on with \"2\""}};

/* No polynomial, in a block with two callbacks before. */
static const char *const misspelled[] = {
    "05",    "x0+05", "+5",   "5x0",      "1*x0",     "5*",      "5*y",
    "x",     "y",     "x0^1", "x0^0",     "x0^02",    "x0^4097", "x0^",
    "x64",   "x01",   "x2",   "x0*x0",    "x1*x0*x0", "x1*x0",   "x0+x0",
    "x0+x1", "-",     "--5",  "5+",       "5+-x0",    "1-x0",    "5z",
    "5/1",   "5/-3",  "5/",   "x0/x1/x0", "5/x1*x0",  "0x",      "x0^99999999999999999999"};

static void say(char *text, const char *format, ...) {
  va_list args;
  size_t at = strlen(text);
  va_start(args, format);
  assert_true(vsnprintf(text + at, SIZE - at, format, args) < (int)(SIZE - at));
  va_end(args);
}

/* A certificate of one site: along x, in this side, the last number is said to be, along y another one. */
static void write_certificate(char *text, const char *lines, const char *side, const char *other_side, int other) {
  size_t count = 1;
  for (const char *c = lines; *c; c++) count += *c == '\n';
  *text = 0;
  say(text, "dyadel certificate 1\noutcome budget\ngoal decided\ncapped no\nsites 1\n%s %s\n", side, other_side);
  say(text, "legal 0\nplaces 0\nbridges 0\ncorners 0\npairs\ntriangles 0\nunproved 0\narea none\nhausdorff none\n");
  say(text, "algebra %zu\n= 0\n%s\npoints 1\n0 %zu %d\nfacts 0\nend\n", count + 1, lines, count, other);
}

/* Appends man 2^exp as certificates write it. */
static void say_number(char *text, mpz_ptr man, long exp) {
  if (exp > 0) {
    mpz_mul_2exp(man, man, (mp_bitcnt_t)exp);
    exp = 0;
  }
  for (; exp < 0 && mpz_sgn(man) && mpz_even_p(man); exp++) mpz_fdiv_q_2exp(man, man, 1);
  char *digits = mpz_get_str(NULL, 10, man);
  say(text, exp && mpz_sgn(man) ? "%s*2^%ld" : "%s", digits, exp);
  free(digits);
}

/* The side of width 5 units, a unit some 2^-40 of the value, that begins `from` units from it. */
static void write_side(char *text, double value, int from) {
  int top;
  mpz_t man;
  frexp(value, &top);
  if (top < 1) top = 1;
  mpz_init(man);
  mpz_set_d(man, floor(ldexp(value, 40 - top)));
  from < 0 ? mpz_sub_ui(man, man, (unsigned)-from) : mpz_add_ui(man, man, (unsigned)from);
  *text = 0;
  say_number(text, man, top - 40);
  say(text, "+");
  mpz_set_ui(man, 5);
  say_number(text, man, top - 40);
  mpz_clear(man);
}

/* NULL: accepted. The text is the certificate. */
static void check(char *text, const char *lines, const char *side, const char *other_side, int other, const char *why) {
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  dyd_error err;
  write_certificate(text, lines, side, other_side, other);
  FILE *in = fmemopen(text, strlen(text), "r");
  dyd_status status = dyd_verify_certificate(&r, in, &err);
  fclose(in);
  if (status != (why ? DYD_E_PARSE : DYD_OK) || (why && strcmp(err.message, why) != 0))
    fail_msg("%.300s\nin %.100s: %d, line %zu: %s", lines, side, status, status ? err.line : 0,
             status ? err.message : "");
}

/* The same of the number alone, and with every allocation failing. */
static void expect(const char *lines, const char *side, const char *why) {
  static char text[SIZE];
  char message[1400];
  size_t faults = 0;
  check(text, lines, side, "0", 0, why);
  if (!every_allocation_fails_well(message, sizeof message, &faults, text, strlen(text)))
    fail_msg("%.300s\nin %.100s: %s", lines, side, message);
}

static void known_values(void **state) {
  (void)state;
  static char side[SIZE];
  for (size_t k = 0; k < sizeof of_known_value / sizeof *of_known_value; k++)
    for (int from = -8; from <= 4; from += 6) { /* on the left of it, around it, on the right */
      write_side(side, of_known_value[k].value, from);
      expect(of_known_value[k].lines, side, from == -2 ? NULL : NOT_THERE);
    }
}

static void exact_values(void **state) {
  (void)state;
  for (size_t k = 0; k < sizeof of_exact_value / sizeof *of_exact_value; k++) {
    expect(of_exact_value[k][0], of_exact_value[k][1], NULL);
    expect(of_exact_value[k][0], "7/11", NOT_THERE);
  }
}

static void refusals(void **state) {
  (void)state;
  char lines[100], why[200];
  for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) expect(refused[k][0], refused[k][1], refused[k][2]);
  for (size_t k = 0; k < sizeof misspelled / sizeof *misspelled; k++) {
    snprintf(lines, sizeof lines, "callback\ncallback\n= %s", misspelled[k]);
    snprintf(why, sizeof why, "\"%s\" is no quotient of polynomials in leaves before", misspelled[k]);
    expect(lines, "0", why);
  }
}

/* Texts of this piece so many times, with something before and behind. */
static const char *repeated(const char *before, const char *piece, size_t times, const char *behind) {
  static char text[SIZE];
  *text = 0;
  say(text, "%s", before);
  size_t length = strlen(piece), at = strlen(text);
  assert_true(at + times * length + strlen(behind) < SIZE);
  for (size_t k = 0; k < times; k++, at += length) memcpy(text + at, piece, length + 1);
  say(text, "%s", behind);
  return text;
}

/* Leaves, digits, terms, coefficients: as many as may be are accepted, one more is not. */
static void limits(void **state) {
  (void)state;
  static const char *const more[] = {"callback", "= 2\nsqrt 65", "= 2\ncbrt 65", "root 1 2 -2,0,1", "cycle 5",
                                     "e",        "pi",           "= 1\ncos 65",  "= 1\nexp 65",     "= 3\nlog 65"};
  expect(repeated("", "callback\n", 63, "callback\n* 64 0"), "0", NULL);
  for (size_t k = 0; k < sizeof more / sizeof *more; k++)
    expect(repeated("", "callback\n", 64, more[k]), "0", NOT_DEFINED);
  expect(repeated("", "callback\n", 63, "= 1\ncos 64"), "0", NOT_DEFINED);
  expect(repeated("= ", "1", 65536, "\n* 0 1"), "0", NULL);
  expect(repeated("= ", "1", 65537, "\n* 0 1"), "0",
         "\"1111111111111111111111111111111111111111\" is no quotient of polynomials in leaves before");
  expect(repeated("callback\n= x0", "+x0", 1 << 14, ""), "0",
         "\"x0+x0+x0+x0+x0+x0+x0+x0+x0+x0+x0+x0+x0+x\" is no quotient of polynomials in leaves before");
  expect(repeated("root -1/2 1/2 0,1", ",0", 998, ",1\n* 0 1"), "0", NULL);
  expect(repeated("root -1/2 1/2 0,1", ",0", 999, ",1\n* 0 1"), "0",
         "\"0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,\" is no end of a bracket, or no polynomial");
  expect(repeated("root 1/1", "0", 2000, " 2 -1,1\n* 0 1"), "0", NULL);
  expect(repeated("root 1/1", "0", 6000, " 2 -1,1\n* 0 1"), "0",
         "the bracket is not seen to hold one root of the polynomial");
}

/* The root 1/2 of a long polynomial, and sqrt 2, in a rectangle of 2^-3000: too much work at the precision it takes. */
static void too_much_work(void **state) {
  (void)state;
  static char text[SIZE], side[SIZE];
  mpz_t root;
  mpz_init_set_ui(root, 2);
  mpz_mul_2exp(root, root, 6000);
  mpz_sqrt(root, root);
  *side = 0;
  say_number(side, root, -3000);
  say(side, "+1*2^-3000");
  for (size_t zeros = 10; zeros <= 600; zeros += 590) {
    const char *lines = repeated("= 2\nsqrt 1\nroot 2/5 3/5 -1,2", ",0", zeros, ",-1,2");
    check(text, lines, "1*2^-1+1*2^-3000", side, 2, zeros == 10 ? NULL : NOT_THERE);
  }
  mpz_clear(root);
}

/* ---- memory ---- */

static size_t bytes_now, bytes_most;

static void *counted_malloc(size_t size) {
  bytes_now += size;
  if (bytes_now > bytes_most) bytes_most = bytes_now;
  void *p = malloc(size);
  assert_non_null(p);
  return p;
}

static void *counted_realloc(void *p, size_t from, size_t to) {
  bytes_now += to - from;
  if (bytes_now > bytes_most) bytes_most = bytes_now;
  p = realloc(p, to);
  assert_non_null(p);
  return p;
}

static void counted_free(void *p, size_t size) {
  bytes_now -= size;
  free(p);
}

/* Cube roots, each of the square of all before times the 998th power of a root: bounds of conjugates grow by 5/3. */
static void say_towers(char *lines, int levels) {
  *lines = 0;
  say(lines, "root 200 300 -1");
  for (int k = 0; k < 2400; k++) say(lines, "0");
  for (int k = 1; k < 999; k++) say(lines, ",0");
  say(lines, ",1");
  for (int k = 0; k < levels; k++) {
    say(lines, "\n= x0^998");
    for (int j = 1; j <= k; j++) say(lines, "*x%d^2", j);
    say(lines, "\ncbrt %d", 2 * k + 2);
  }
}

/* What forged lines make long is given up, before it fills the memory. */
static void no_long_numbers(void **state) {
  (void)state;
  static char text[SIZE], lines[SIZE];
  mp_set_memory_functions(counted_malloc, counted_realloc, counted_free);
  say_towers(lines, 6);
  check(text, lines, "0", "0", 0, NOT_THERE);
  assert_in_range(bytes_most, 0, (size_t)4 << 20);
  *lines = 0; /* x - x for an x too large for an enclosure; long products of that */
  say(lines, "= 200\nexp 1\n^ 2 120\n- 3 3\n= 1");
  for (int k = 0; k < 9000; k++) say(lines, "0");
  for (int k = 4; k < 400; k++) say(lines, "\n* 5 %d", k == 4 ? 4 : k + 1);
  bytes_most = 0;
  check(text, lines, "0+1", "0", 0, NOT_THERE);
  assert_in_range(bytes_most, 0, (size_t)32 << 20);
  *lines = 0; /* an end of which powers would be made */
  say(lines, " 2 -1");
  for (int k = 1; k < 400; k++) say(lines, ",0");
  say(lines, ",1");
  bytes_most = 0;
  check(text, repeated("root -1", "0", 20000, lines), "0", "0", 0,
        "the bracket is not seen to hold one root of the polynomial");
  assert_in_range(bytes_most, 0, (size_t)1 << 20);
  mp_set_memory_functions(NULL, NULL, NULL);
}

/* Facts of each kind, by either method, of points around a square and on its diagonal, one of them twice. */
static void facts(void **state) {
  (void)state;
  static const char text[] =
      "dyadel certificate 1\noutcome budget\ngoal decided\ncapped no\nsites 8\n0 0\n1+1 0\n1+1 1+1\n0 1+1\n"
      "1*2^1+1 1*2^1+1\n0 0\n1/3 1/7\n= 6\nlegal 0\nplaces 0\nbridges 0\ncorners 0\npairs\ntriangles 0\nunproved "
      "21\narea none\n"
      "hausdorff none\nalgebra 4\n= 0\n= 2\nsqrt 1\n+ 2 2\npoints 6\n0 0 0\n1 2 0\n2 2 2\n3 0 2\n4 3 3\n5 0 0\n"
      "facts 6\nline 0 2 4 identity\nline 4 2 5 bound\ncircle 0 1 2 3 identity\ncircle 3 5 1 2 bound\n"
      "same 0 5 identity\nsame 5 0 bound\nend\n";
  char message[1400], verdict[600];
  bool over;
  size_t faults = 0;
  assert_int_equal(verdict_of(verdict, sizeof verdict, &over, text, strlen(text), 0), DYD_OK);
  assert_non_null(strstr(verdict, "facts 3 and 3"));
  for (size_t phase = 0; phase < 16; phase++) {
    faults = phase;
    if (!every_allocation_fails_well(message, sizeof message, &faults, text, strlen(text))) fail_msg("%s", message);
  }
  static const char *const wrong[][2] = {{"2 4 identity", "1 4 identity"}, {"2 5 bound", "1 5 bound"},
                                         {"2 3 identity", "2 4 identity"}, {"1 2 bound", "1 4 bound"},
                                         {"0 5 identity", "0 2 identity"}, {"5 0 bound", "5 1 bound"}};
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
    char other[sizeof text];
    strcpy(other, text);
    memcpy(strstr(other, wrong[k][0]), wrong[k][1], strlen(wrong[k][1]));
    assert_int_equal(verdict_of(verdict, sizeof verdict, &over, other, strlen(other), 0), DYD_E_PARSE);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(known_values),   cmocka_unit_test(exact_values),
                                     cmocka_unit_test(refusals),       cmocka_unit_test(limits),
                                     cmocka_unit_test(facts),          cmocka_unit_test(too_much_work),
                                     cmocka_unit_test(no_long_numbers)};
  return cmocka_run_group_tests_name("numbers of certificates", tests, NULL, NULL);
}
