(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What the checker proves of a block. The hints here, roots, pi, the precision, need no proof: of wrong ones it says no. *)
open Source

(* floor of the k-th root *)
let root_hint k z =
  let k = Z.to_int k in
  if Z.sign z >= 0 then Z.root z k
  else
    let r = Z.root (Z.neg z) k in
    Z.neg (if Z.equal (Z.pow r k) (Z.neg z) then r else Z.succ r)

(* floor (pi u), by Machin's series *)
let pi_hint u =
  let u = Z.shift_left u 64 in
  let arctan n =
    let square = n * n in
    let rec add sum power k =
      if Z.equal power Z.zero then sum
      else
        let term = Z.div power (Z.of_int (2 * k + 1)) in
        add (if k land 1 = 0 then Z.add sum term else Z.sub sum term) (Z.div power (Z.of_int square)) (k + 1)
    in
    add Z.zero (Z.div u (Z.of_int n)) 0
  in
  Z.shift_right (Z.sub (Z.mul (arctan 5) (Z.of_int 16)) (Z.mul (arctan 239) (Z.of_int 4))) 64

(* One step of Newton's at x / u, in units of 1 / u. *)
let newton (r : Checker.bracket) u x =
  let add c (f, slope, below) = (Z.add (Z.mul c below) (Z.mul x f), Z.add (Z.mul u f) (Z.mul x slope), Z.mul below u) in
  let f, slope, _ = List.fold_right add r.coefficients (Z.zero, Z.zero, Z.one) in
  if Z.sign slope = 0 then x else Z.sub x (Z.div (Z.mul u f) slope)

let few_bits = 200
let spare_bits = 16

(* floor (z u) for the zero z, by bisection: of few integers around what half of the digits lead to, if it is there. *)
let rec zero_hint u (r : Checker.bracket) =
  let left = Checker.sign_at r.coefficients r.lo_num r.lo_den in
  let is_left z = Z.equal (Checker.sign_at r.coefficients z u) left in
  let rec search lo hi =
    if Z.leq (Z.sub hi lo) Z.one then lo
    else
      let middle = Z.shift_right (Z.add lo hi) 1 in
      if is_left middle then search middle hi else search lo middle
  in
  if Z.sign r.lo_den <= 0 || Z.sign r.hi_den <= 0 then Z.zero
  else
    let lo = Z.fdiv (Z.mul r.lo_num u) r.lo_den and hi = Z.cdiv (Z.mul r.hi_num u) r.hi_den in
    let bits = Z.numbits u in
    if bits < few_bits then search lo hi
    else
      let less = (bits / 2) - spare_bits in
      let x = newton r u (Z.shift_left (zero_hint (Z.shift_right u less) r) less) in
      let near = Z.max lo (Z.sub x (Z.of_int 2)) and beyond = Z.min hi (Z.add x (Z.of_int 2)) in
      if Z.lt near beyond && is_left near && not (is_left beyond) then search near beyond else search lo hi

let most = Z.shift_left Z.one (1 lsl 18)
(* As in `dyadel verify`: up to the last but one for signs, up to the last for places. *)
let precisions = [ 128; 512; 2048; 4096; 16384 ]
let sign_precision = 4096

(* The results proved of blocks. *)
type proof = {
  points : int;  (* that are in their rectangles *)
  facts : int;  (* that hold *)
  joined : (int * int) list;  (* sites that are the same *)
  sets : Checker.tied_set list;  (* on a circle or a line *)
  unseen_points : int;
  unseen_facts : int;
}

(* Facts by identity reduce to 0. *)
let hint_for hint (f : Described.fact) = if f.by_bound then hint else Vanishing.no_hint

(* Of one block at one precision: the first line that is not taken, or which points and facts are. *)
let at_precision (c : Reader.certificate) (b : Described.block) table bits =
  let u = Z.shift_left Z.one bits in
  match Checker.run most root_hint zero_hint u (Checker.pi_at most pi_hint u) Checker.nothing Z.zero b.numbers with
  | Inr k -> Error (b.first + 1 + Z.to_int k)
  | Inl st ->
    let hint = Vanishing.hint table most bits st in
    let look (line, i, p) =
      if Checker.place_outside u st p c.rects.(i) then
        raise (Bad (line, Printf.sprintf "the point described does not lie in the rectangle of site %d" i));
      Checker.place_in most u st hint p c.rects.(i)
    in
    let holds (f : Described.fact) =
      if Checker.fact_fails most u st Vanishing.no_hint f.says then raise (Bad (f.said_at, "the fact does not hold"));
      Checker.fact_holds most u st (hint_for hint f) f.says
    in
    let points = List.length (List.filter look b.points) in
    Ok (points, List.filter holds b.facts, (u, st, hint))

let sets_of facts (units, block, hint) =
  let set (f : Described.fact) =
    match f.says with
    | OnCircle _ | OnLine _ ->
      Some { Checker.units; block; null_hint = hint_for hint f; says = f.says; site_names = List.map Z.of_int f.members }
    | Same _ -> None
  in
  List.filter_map set facts

(* The most that is seen, at rising precision. *)
let of_block c (b : Described.block) =
  let table = Vanishing.table b.numbers in
  let seen (points, facts, _) = points = List.length b.points && List.length facts = List.length b.facts in
  let is_of_use bits = function
    | Ok (points, _, _) -> bits <= sign_precision || points < List.length b.points
    | Error _ -> bits <= sign_precision
  in
  let rec look last = function
    | [] -> last
    | bits :: _ when not (is_of_use bits last) -> last
    | bits :: more ->
      (match at_precision c b table bits with
      | Ok found when seen found -> Ok found
      | found -> look found more)
  in
  look (Error b.first) precisions

let of_blocks (c : Reader.certificate) =
  let add p (b : Described.block) =
    let points, facts, sets =
      match of_block c b with
      | Ok (points, facts, known) -> (points, facts, sets_of facts known)
      | Error line -> raise (Bad (line, "the number is not seen to be defined, or to be what the line says"))
    in
    let same (f : Described.fact) = match (f.says, f.members) with Same _, [ i; j ] -> Some (i, j) | _ -> None in
    { points = p.points + points; facts = p.facts + List.length facts; joined = List.filter_map same facts @ p.joined;
      sets = sets @ p.sets;
      unseen_points = p.unseen_points + List.length b.points - points;
      unseen_facts = p.unseen_facts + List.length b.facts - List.length facts }
  in
  List.fold_left add { points = 0; facts = 0; joined = []; sets = []; unseen_points = 0; unseen_facts = 0 } c.blocks

(* How many aliases of sites that are not exact are not proved to be the same points. *)
let loose_aliases (c : Reader.certificate) p =
  let parent = Hashtbl.create 100 in
  let rec top k = match Hashtbl.find_opt parent k with Some j -> top j | None -> k in
  let join (i, j) = if top i <> top j then Hashtbl.replace parent (top i) (top j) in
  List.iter join p.joined;
  List.length (List.filter (fun (k, other) -> top k <> top other) c.aliased)
