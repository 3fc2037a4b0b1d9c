(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Hints of why a polynomial p in leaves is 0 that does not reduce to 0: m and w with p^m w = 0, w not 0 at the true
   leaves. Multiplication by p is a matrix over the reduced monomials, and w a vector that it takes to 0: it is found
   modulo a prime and lifted. Nothing proves this file; the checker takes no hint that is wrong. *)

(* As far as is looked: degree of the leaves over the integers, bits of the separation bound [SEP-1] as in
   `dyadel verify`, and the work that a root takes there, digits of w. *)
let most_degree = 1024
let most_bits = 8192
let most_work = Z.shift_left Z.one 46
let most_digits = 1024
let prime = 0x7fffffff
let prime_z = Z.of_int prime

let no_hint _ = (Z.zero, [])

(* ---- reduced monomials ---- *)

(* Leaves that p depends on, those of their relations among them, each with its degree; none, when one is not algebraic,
   or the degree of all is too large. *)
let leaves_of rs p =
  let uses = Array.make (Array.length rs) false in
  let use p = List.iter (fun (_, m) -> List.iteri (fun k e -> if Z.sign e > 0 then uses.(k) <- true) m) p in
  use p;
  let rec down k degree found =
    if k < 0 then Some found
    else if not uses.(k) then down (k - 1) degree found
    else
      match rs.(k) with
      | Some { Checker.degree = d; rest } when Z.sign d > 0 && Z.leq (Z.mul degree d) (Z.of_int most_degree) ->
        use rest;
        down (k - 1) (Z.mul degree d) ((k, Z.to_int d) :: found)
      | _ -> None
  in
  down (Array.length rs - 1) Z.one []

let size_of leaves = List.fold_left (fun n (_, d) -> n * d) 1 leaves

(* ---- the bound of `dyadel verify`, of all choices of zeros: it looks no further than that ---- *)

(* The least number whose k-th power is at least z. *)
let root_above z k = let r = Z.root z k in if Z.equal (Z.pow r k) z then r else Z.succ r

let rec bound_of numbers leaves p =
  let power k e = if Z.sign e = 0 then Z.one else Z.pow (leaf_bound numbers leaves (List.nth leaves k)) (Z.to_int e) in
  let term (c, m) = List.fold_left Z.mul (Z.abs c) (List.mapi power m) in
  List.fold_left (fun sum t -> Z.add sum (term t)) Z.zero p

and leaf_bound numbers leaves (leaf : Checker.leaf) =
  match (leaf.leaf_kind, leaf.leaf_relation) with
  | Multiple (_, a), Some { rest; degree } ->
    (match numbers.(Z.to_int a) with
    | Checker.Root _ -> Z.succ (List.fold_left (fun most (c, _) -> Z.max most (Z.abs c)) Z.zero rest)
    | _ -> root_above (bound_of numbers leaves rest) (Z.to_int degree))
  | _ -> Z.of_int 2

let is_within_effort numbers (all : Checker.leaf list) leaves p =
  let bits = Z.numbits (bound_of numbers all p) * (size_of leaves - 1) in
  let rec precision p = if p > bits + 16 then p else precision (2 * p) in
  let work n = Z.mul (Z.pow (Z.of_int n) 2) (Z.pow (Z.of_int (precision 128)) 3) in
  let is_found (k, _) =
    match (List.nth all k).leaf_kind with
    | Multiple (_, a) ->
      (match numbers.(Z.to_int a) with
      | Checker.Root (r, _) -> Z.leq (work (List.length r.coefficients)) most_work
      | _ -> true)
    | _ -> true
  in
  bits < most_bits && List.for_all is_found leaves

(* The place of a monomial in the order of numbers with the digits e; none: it is not reduced. *)
let place_of leaves m =
  let m = Array.of_list m in
  let digit (at, unit) (k, d) =
    let e = if k < Array.length m then Z.to_int m.(k) else 0 in
    if e >= d then raise Not_found else (at + (e * unit), unit * d)
  in
  fst (List.fold_left digit (0, 1) leaves)

let monomial_at leaves at =
  let place (at, before, m) (k, d) =
    let zeros = List.init (k - before) (fun _ -> Z.zero) in
    match at mod d with
    | 0 -> (at / d, before, m)
    | e -> (at / d, k + 1, m @ zeros @ [ Z.of_int e ])
  in
  let _, _, m = List.fold_left place (at, 0, []) leaves in
  m

let poly_of leaves w =
  let terms = List.mapi (fun j c -> (c, monomial_at leaves j)) (Array.to_list w) in
  let descends (_, a) (_, b) =
    match Checker.compare_monomials a b with Checker.Gt -> -1 | Checker.Eq -> 0 | Checker.Lt -> 1
  in
  List.sort descends (List.filter (fun (c, _) -> Z.sign c <> 0) terms)

(* Column j: p times monomial j. *)
let matrix_of rs leaves p =
  let n = size_of leaves in
  let a = Array.make_matrix n n Z.zero in
  for j = 0 to n - 1 do
    List.iter (fun (c, m) -> a.(place_of leaves m).(j) <- c) (Checker.product_of rs p [ (Z.one, monomial_at leaves j) ])
  done;
  a

(* ---- modulo the prime ---- *)

let small z = Z.to_int (Z.erem z prime_z)

let rec power_mod x n = if n = 0 then 1 else
  let y = power_mod (x * x mod prime) (n / 2) in
  if n land 1 = 1 then y * x mod prime else y

(* Clears column c of all rows but r, from c on. *)
let clear a r c =
  let row = a.(r) in
  let inverse = power_mod row.(c) (prime - 2) in
  for j = c to Array.length row - 1 do row.(j) <- row.(j) * inverse mod prime done;
  Array.iteri (fun i other ->
      let f = other.(c) in
      if i <> r && f <> 0 then
        for j = c to Array.length row - 1 do other.(j) <- (other.(j) + ((prime - f) * row.(j))) mod prime done) a

(* Row by row: the rows and columns, among the first n, of a part of a with full rank. a is changed. *)
let pivots a n =
  let names = Array.init (Array.length a) Fun.id in
  let swap x i j = let y = x.(i) in x.(i) <- x.(j); x.(j) <- y in
  let rec search r c found =
    if c = n || r = Array.length a then List.rev found
    else
      let rec first i = if i = Array.length a || a.(i).(c) <> 0 then i else first (i + 1) in
      let i = first r in
      if i = Array.length a then search r (c + 1) found
      else begin
        swap a i r; swap names i r;
        clear a r c;
        search (r + 1) (c + 1) ((names.(r), c) :: found)
      end
  in
  search 0 0 []

(* The inverse of a square matrix of full rank. *)
let inverse b =
  let n = Array.length b in
  let unit i = Array.init n (fun j -> if i = j then 1 else 0) in
  let a = Array.mapi (fun i row -> Array.append (Array.map small row) (unit i)) b in
  ignore (pivots a n);
  Array.map (fun row -> Array.sub row n n) a

(* ---- fractions ---- *)

(* A small numerator and denominator of x modulo q. *)
let fraction_of x q =
  let bound = Z.sqrt (Z.shift_right q 1) in
  let rec divide r0 t0 r1 t1 =
    if Z.leq r1 bound then if Z.sign t1 < 0 then (Z.neg r1, Z.neg t1) else (r1, t1)
    else let k = Z.div r0 r1 in divide r1 t1 (Z.sub r0 (Z.mul k r1)) (Z.sub t0 (Z.mul k t1))
  in
  divide q Z.zero x Z.one

(* Numerators of all x modulo q, and their denominator. *)
let fractions_of x q =
  let half = Z.shift_right q 1 and bound = Z.sqrt (Z.shift_right q 1) in
  let below = ref Z.one in
  Array.iter (fun x ->
      let y = Z.erem (Z.mul x !below) q in
      if Z.gt (Z.min y (Z.sub q y)) bound then below := Z.mul !below (snd (fraction_of y q))) x;
  let over x = let y = Z.erem (Z.mul x !below) q in if Z.gt y half then Z.sub y q else y in
  (Array.map over x, !below)

(* ---- what a matrix takes to 0 ---- *)

let along row w =
  let s = ref Z.zero in
  Array.iteri (fun j z -> if Z.sign z <> 0 then s := Z.add !s (Z.mul z w.(j))) row;
  !s
let along_mod row w =
  let s = ref 0 in
  Array.iteri (fun j z -> s := (!s + (z * w.(j))) mod prime) row;
  !s

let takes_to_zero a w = Array.for_all (fun row -> Z.sign (along row w) = 0) a

(* x with b x = y, digit by digit; `good` of the numerators and denominator tells when it is all. *)
let lifted b y good =
  let n = Array.length b in
  let c = inverse b and rest = Array.copy y and x = Array.make n Z.zero in
  let rec add digits q =
    let now = Array.map small rest in
    let digit = Array.map (fun row -> Z.of_int (along_mod row now)) c in
    Array.iteri (fun i z -> x.(i) <- Z.add x.(i) (Z.mul q z)) digit;
    Array.iteri (fun i row -> rest.(i) <- Z.divexact (Z.sub rest.(i) (along row digit)) prime_z) b;
    let q = Z.mul q prime_z and digits = digits + 1 in
    let found = if digits land (digits - 1) = 0 then good (fractions_of x q) else None in
    if found <> None || digits = most_digits then found else add digits q
  in
  add 0 Z.one

(* Some vector that a takes to 0: with many of them, one is hardly 0 at the true leaves by chance. *)
let kernel_vector a =
  let n = Array.length a in
  let found = pivots (Array.map (Array.map small) a) n in
  let rows = Array.of_list (List.map fst found) and columns = Array.of_list (List.map snd found) in
  let is_pivot = Array.make n false in
  Array.iter (fun c -> is_pivot.(c) <- true) columns;
  if Array.length rows = n then None
  else
    let chosen j = Z.of_int (1 + (Hashtbl.hash j mod 1048576)) in
    let free = Array.init n (fun j -> if is_pivot.(j) then Z.zero else chosen j) in
    let b = Array.map (fun i -> Array.map (fun j -> a.(i).(j)) columns) rows in
    let y = Array.map (fun i -> Z.neg (along a.(i) free)) rows in
    let whole (x, below) =
      let w = Array.map (Z.mul below) free in
      Array.iteri (fun i c -> w.(c) <- x.(i)) columns;
      let g = Array.fold_left Z.gcd Z.zero w in
      if Z.sign g > 0 && takes_to_zero a w then Some (Array.map (fun z -> Z.divexact z g) w) else None
    in
    if rows = [||] then whole ([||], Z.one) else lifted b y whole

(* ---- hints ---- *)

let rec power rs p m = if m = 1 then p else Checker.product_of rs p (power rs p (m - 1))

(* m and w. *)
let cofactor numbers st p m =
  let rs = Checker.relations st in
  match leaves_of (Array.of_list rs) p with
  | Some leaves when m <= size_of leaves && is_within_effort numbers st.leaves leaves p ->
    (match kernel_vector (matrix_of rs leaves (power rs p m)) with
    | Some w -> Some (Z.of_int m, poly_of leaves w)
    | None | (exception Not_found) -> None)
  | _ -> None

(* A precision that goes so far beyond the digits of w shows it, if it is not 0. *)
let slack = 512
let bits_needed (_, w) = slack + List.fold_left (fun n (c, _) -> max n (Z.numbits c)) 0 w

(* Cube roots of numbers that are 0 but do not reduce to 0 do so only in a power. *)
let choices = [ 1; 3; 9 ]

(* Of one block: the result for each polynomial. *)
type table = { numbers : Checker.line array; found : (Checker.poly, Checker.cofactor option Lazy.t list) Hashtbl.t }

let table numbers = { numbers = Array.of_list numbers; found = Hashtbl.create 100 }

(* The hint of p at this precision. *)
let hint t most bits st p =
  let u = Z.shift_left Z.one bits in
  let known =
    match Hashtbl.find_opt t.found p with
    | Some known -> known
    | None ->
      let known = List.map (fun m -> lazy (cofactor t.numbers st p m)) choices in
      Hashtbl.replace t.found p known; known
  in
  let is_seen w = not (Z.equal (Checker.sign_of (Checker.enclose_poly most u (Checker.held st) w)) Z.zero) in
  let rec best = function
    | [] -> no_hint p
    | choice :: more ->
      (match Lazy.force choice with
      | None -> no_hint p
      | Some found when is_seen (snd found) || bits < bits_needed found -> found
      | Some _ -> best more)
  in
  best known
