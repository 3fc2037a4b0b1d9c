(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Reads a block, which says what points are. Nothing proves this file: it takes each line in its only spelling. *)
open Source

type fact = {
  said_at : int;
  members : int list;  (* sites *)
  says : Checker.fact;
  by_bound : bool;
}

type block = {
  first : int;  (* its line *)
  numbers : Checker.line list;
  points : (int * int * Checker.place) list;  (* line, site, place *)
  facts : fact list;
}

let most_leaves = 64
let most_exponent = 4096
let most_coefficients = 1001

(* ---- polynomials ---- *)

(* x3 or x3^2: the leaf and its exponent. *)
let power s text =
  if not (String.starts_with ~prefix:"x" text) then bad s "%S is no leaf" text;
  match String.split_on_char '^' (after text 1) with
  | [ k ] -> (count s k, 1)
  | [ k; e ] -> (count s k, count s e)
  | _ -> bad s "%S is no power of a leaf" text

let monomial s powers =
  let add (before, m) (k, e) =
    if k < before || k >= most_leaves || e < 1 || e > most_exponent then bad s "leaves are not in order, or too large";
    (k + 1, m @ List.init (k - before) (fun _ -> Z.zero) @ [ Z.of_int e ])
  in
  snd (List.fold_left add (0, []) powers)

(* A term without its sign. *)
let term s text =
  match String.split_on_char '*' text with
  | first :: rest when not (String.starts_with ~prefix:"x" text) -> (integer s first, monomial s (List.map (power s) rest))
  | powers -> (Z.one, monomial s (List.map (power s) powers))

(* The only spelling. *)
let spelled p =
  let leaf k e =
    if Z.equal e Z.zero then None
    else Some (if Z.equal e Z.one then Printf.sprintf "x%d" k else Printf.sprintf "x%d^%s" k (Z.to_string e))
  in
  let term first (c, m) =
    let leaves = List.filter_map Fun.id (List.mapi leaf m) and size = Z.abs c in
    let factors = if leaves <> [] && Z.equal size Z.one then leaves else Z.to_string size :: leaves in
    (if Z.sign c < 0 then "-" else if first then "" else "+") ^ String.concat "*" factors
  in
  if p = [] then "0" else String.concat "" (List.mapi (fun k t -> term (k = 0) t) p)

(* P: terms with their signs, in descending order. *)
let polynomial s text =
  let n = String.length text in
  let ends = List.filter (fun k -> k = n || (k > 0 && (text.[k] = '+' || text.[k] = '-'))) (List.init (n + 1) Fun.id) in
  let read (start, terms) stop =
    let piece = String.sub text start (stop - start) in
    let signed = piece <> "" && (piece.[0] = '-' || piece.[0] = '+') in
    let c, m = term s (if signed then after piece 1 else piece) in
    (stop, ((if signed && piece.[0] = '-' then Z.neg c else c), m) :: terms)
  in
  let found = if text = "0" then [] else List.rev (snd (List.fold_left read (0, []) ends)) in
  let rec descends = function
    | (_, a) :: ((_, b) :: _ as rest) -> Checker.compare_monomials a b = Checker.Gt && descends rest
    | _ -> true
  in
  let is_null (c, _) = Z.equal c Z.zero in
  if spelled found <> text || not (descends found) || List.exists is_null found then bad s "%.40S is no polynomial in leaves" text;
  found

(* V: P or P/Q. *)
let quotient s text =
  match String.split_on_char '/' text with
  | [ p ] -> (polynomial s p, [ (Z.one, []) ])
  | [ p; q ] ->
    let q = polynomial s q in
    (match q with [] -> bad s "a denominator is 0" | [ (c, []) ] when Z.leq c Z.one -> bad s "a denominator is too small" | _ -> ());
    (polynomial s p, q)
  | _ -> bad s "%.40S is no quotient of polynomials" text

(* ---- numbers ---- *)

(* m or m/d in lowest terms. *)
let fraction s text =
  match List.map (integer s) (String.split_on_char '/' text) with
  | [ m ] -> (m, Z.one)
  | [ m; d ] when Z.gt d Z.one && Z.equal (Z.gcd m d) Z.one -> (m, d)
  | _ -> bad s "%S is no fraction in lowest terms" text

let bracket s lo hi f =
  let lo_num, lo_den = fraction s lo and hi_num, hi_den = fraction s hi in
  let coefficients = List.map (integer s) (String.split_on_char ',' f) in
  let n = List.length coefficients in
  if n < 2 || n > most_coefficients || Z.sign (List.nth coefficients (n - 1)) <= 0 then bad s "%.40S is no polynomial" f;
  { Checker.coefficients; lo_num; lo_den; hi_num; hi_den }

(* Line n of the block. *)
let number s n : Checker.line =
  let operand text = let k = count s text in if k < n then Z.of_int k else bad s "%s is no number before" text in
  let stated = function [] -> None | [ v ] -> Some (quotient s v) | _ -> bad s "something follows what is stated" in
  let exponent text =
    let e = small s text in
    if abs e > most_exponent then bad s "%s is too large" text else Z.of_int e
  in
  match words s with
  | [ "="; v ] -> let p, q = quotient s v in Value (p, q)
  | [ "+"; a; b ] -> Plus (operand a, operand b)
  | [ "-"; a; b ] -> Minus (operand a, operand b)
  | [ "*"; a; b ] -> Times (operand a, operand b)
  | [ "/"; a; b ] -> Divided (operand a, operand b)
  | [ "min"; a; b ] -> Least (operand a, operand b)
  | [ "max"; a; b ] -> Greatest (operand a, operand b)
  | [ "^"; a; e ] -> Power (operand a, exponent e)
  | [ "neg"; a ] -> Opposite (operand a)
  | [ "claim"; a ] -> Claim (operand a)
  | [ "abs"; a ] -> Absolute (operand a)
  | "sqrt" :: a :: v -> SquareRoot (operand a, stated v)
  | "cbrt" :: a :: v -> CubeRoot (operand a, stated v)
  | [ "cos"; a ] -> Cosine (operand a)
  | [ "sin"; a ] -> Sine (operand a)
  | [ "tan"; a ] -> Tangent (operand a)
  | [ "exp"; a ] -> Exponential (operand a)
  | [ "sinh"; a ] -> HyperbolicSine (operand a)
  | [ "cosh"; a ] -> HyperbolicCosine (operand a)
  | [ "tanh"; a ] -> HyperbolicTangent (operand a)
  | [ "pi" ] -> Pi
  | [ "e" ] -> Euler
  | "root" :: lo :: hi :: f :: v -> Root (bracket s lo hi f, stated v)
  | [ "callback" ] -> Callback
  | [ "log"; a ] -> Inverse (Logarithm, operand a)
  | [ "asin"; a ] -> Inverse (Arcsine, operand a)
  | [ "acos"; a ] -> Inverse (Arccosine, operand a)
  | [ "atan"; a ] -> Inverse (Arctangent, operand a)
  | [ "cycle"; n ] -> Cycle (exponent n)
  | _ -> bad s "this is no number"

(* ---- points, facts ---- *)

let point s size n last _ =
  match words s with
  | [ i; a; b ] ->
    let number text = let k = count s text in if k < n then Z.of_int k else bad s "%s is no number of the block" text in
    let i = count s i in
    if i >= size then bad s "%d is no site" i;
    in_order s last i;
    (s.line, i, { Checker.at_first = number a; at_second = number b })
  | _ -> bad s "a site and two numbers are missing"

let fact s place _ =
  let method_of = function "identity" -> false | "bound" -> true | word -> bad s "%S is no method" word in
  match words s with
  | (("same" | "line" | "circle") as kind) :: rest when rest <> [] ->
    let rest = List.rev rest in
    let by_bound = method_of (List.hd rest) and members = List.rev_map (count s) (List.tl rest) in
    let at k = match Hashtbl.find_opt place k with Some p -> p | None -> bad s "site %d is not described" k in
    if List.length (List.sort_uniq compare members) < List.length members then bad s "a point occurs twice";
    let says : Checker.fact =
      match (kind, List.map at members) with
      | "same", [ a; b ] -> Same (a, b)
      | "line", a :: b :: (_ :: _ as l) -> OnLine (a, b, l)
      | "circle", a :: b :: c :: (_ :: _ as l) -> OnCircle (a, b, c, l)
      | _ -> bad s "the fact has a wrong number of points"
    in
    { said_at = s.line; members; says; by_bound }
  | _ -> bad s "this is no fact"

(* After the words "algebra K". *)
let block s size k =
  let first = s.line and k = count s k in
  let rec read n found = if n = k then List.rev found else let line = number s n in read (n + 1) (line :: found) in
  let numbers = read 0 [] in
  let points = rows s "points" (point s size k (ref (-1))) in
  let place = Hashtbl.create 100 in
  List.iter (fun (_, i, p) -> Hashtbl.replace place i p) points;
  { first; numbers; points; facts = rows s "facts" (fact s place) }
