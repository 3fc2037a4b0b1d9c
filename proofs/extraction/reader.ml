(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Reads certificates (include/dyadel/certificate.h) and hands them to the extracted checker. Nothing proves this file:
   it turns text into the numbers written there. It also chooses the unit and finds triangles, corners and fans; wrong
   ones cannot make a wrong answer.
   Usage: checker FILE...   (exit status 1 when a certificate is rejected)
   "complete": every pair that is not listed as legal is proved to be illegal.
   "diagram not checked": the certificate has a section on the Voronoi diagram; this checker does not know it, and reads
   no line of what follows the corners. *)
open Checker

exception Bad of string

(* ---- numbers ---- *)

let rec positive_of_int n = if n = 1 then XH else if n land 1 = 1 then XI (positive_of_int (n / 2)) else XO (positive_of_int (n / 2))
let of_int n = if n = 0 then Z0 else if n > 0 then Zpos (positive_of_int n) else Zneg (positive_of_int (-n))

(* Fifteen digits at a time. *)
let of_digits text =
  let chunk = 15 in
  let rec power k = if k = 0 then 1 else 10 * power (k - 1) in
  let rec go acc from =
    if from >= String.length text then acc
    else
      let n = min chunk (String.length text - from) in
      let part = String.sub text from n in
      String.iter (fun c -> if c < '0' || c > '9' then raise (Bad ("digits: " ^ text))) part;
      go (Z.add (Z.mul acc (of_int (power n))) (of_int (int_of_string ("0u" ^ part)))) (from + n)
  in
  if text = "" then raise (Bad "no digits") else go Z0 0

let of_text text =
  if text <> "" && text.[0] = '-' then Z.opp (of_digits (String.sub text 1 (String.length text - 1))) else of_digits text

(* m or m*2^e *)
let number text =
  match String.index_opt text '*' with
  | None -> { man = of_text text; expo = Z0; den = Zpos XH }
  | Some k ->
    let e = String.sub text (k + 3) (String.length text - k - 3) in
    { man = of_text (String.sub text 0 k); expo = of_int (int_of_string e); den = Zpos XH }

let split_at text k = (String.sub text 0 k, String.sub text (k + 1) (String.length text - k - 1))

(* man 2^expo of the sum of two numbers *)
let sum a b =
  let e = Z.min a.expo b.expo in
  let shifted n = Z.shiftl n.man (Z.add n.expo (Z.opp e)) in
  { man = Z.add (shifted a) (shifted b); expo = e; den = Zpos XH }

(* The two ends of a side: lo, lo/d or lo+w. *)
let side text =
  match (String.index_opt text '/', String.index_opt text '+') with
  | Some k, _ ->
    let lo, d = split_at text k in
    let n = { (number lo) with den = of_text d } in
    (n, n)
  | None, Some k ->
    let lo, w = split_at text k in
    (number lo, sum (number lo) (number w))
  | None, None -> (number text, number text)

(* ---- lines ---- *)

let words line = String.split_on_char ' ' line

let read_certificate channel =
  let line () = try input_line channel with End_of_file -> raise (Bad "too short") in
  let rec heading name =
    match words (line ()) with [ w; count ] when w = name -> int_of_string count | _ -> heading name
  in
  let sites =
    List.init (heading "sites") (fun k -> (k, words (line ())))
    |> List.filter_map (function
         | _, "=" :: _ -> None
         | k, [ x; y ] ->
           let left, right = side x and low, high = side y in
           Some { name = of_int k; left; right; low; high }
         | _ -> raise (Bad "site"))
  in
  let edges =
    List.init (heading "legal") (fun _ ->
        match words (line ()) with
        | [ i; j; x; y ] -> { from = of_text i; to0 = of_text j; at_x = number x; at_y = number y }
        | _ -> raise (Bad "legal pair"))
  in
  let corners =
    List.init (heading "corners") (fun _ ->
        match words (line ()) with
        | [ i; x; y ] ->
          let x = number x and y = number y in
          let e = Z.min x.expo y.expo in
          let whole n = Z.shiftl n.man (Z.add n.expo (Z.opp e)) in
          { vertex = of_text i; ux = whole x; uy = whole y }
        | _ -> raise (Bad "corner"))
  in
  let rec has_diagram () =
    match input_line channel with
    | line -> List.hd (words line) = "window" || has_diagram ()
    | exception End_of_file -> false
  in
  (sites, edges, corners, has_diagram ())

(* ---- the unit ---- *)

let numbers sites edges =
  List.concat_map (fun s -> [ s.left; s.right; s.low; s.high ]) sites
  @ List.concat_map (fun e -> [ e.at_x; e.at_y ]) edges

let unit_of sites edges =
  let all = numbers sites edges in
  ( List.fold_left (fun d n -> if n.den = Zpos XH then d else Z.lcm d n.den) (Zpos XH) all,
    List.fold_left (fun e n -> Z.max e (Z.opp n.expo)) Z0 all )

(* ---- hints: triangles and fans ---- *)

let rec int_of_positive = function XH -> 1 | XO p -> 2 * int_of_positive p | XI p -> (2 * int_of_positive p) + 1
let to_int = function Z0 -> 0 | Zpos p -> int_of_positive p | Zneg p -> -int_of_positive p

(* The neighbours of every site, counterclockwise around its lower left corner. *)
let rotation boxes edges =
  let near = Hashtbl.create 1000 in
  let add a b = Hashtbl.replace near a (b :: Option.value ~default:[] (Hashtbl.find_opt near a)) in
  List.iter (fun e -> let i = to_int e.from and j = to_int e.to0 in add i j; add j i) edges;
  let right a b = Z.ltb a.x0 b.x0 || (a.x0 = b.x0 && Z.ltb a.y0 b.y0) in
  let compare_around a b c =
    match (right a b, right a c) with
    | true, false -> -1
    | false, true -> 1
    | _ -> ( match turn a b c with Zpos _ -> -1 | Z0 -> 0 | Zneg _ -> 1)
  in
  let sorted = Hashtbl.create 1000 in
  Hashtbl.iter
    (fun a l ->
      let box = Hashtbl.find boxes in
      Hashtbl.replace sorted a
        (Array.of_list (List.sort (fun b c -> compare_around (box a) (box b) (box c)) l)))
    near;
  sorted

(* Round each site: where two neighbours that follow one another are neighbours, a triangle; a site without a gap, or with
   one, gives a fan. *)
let hints boxes edges =
  let around = rotation boxes edges and is_edge = Hashtbl.create 1000 in
  List.iter (fun e -> Hashtbl.replace is_edge (to_int e.from, to_int e.to0) ()) edges;
  let closes a i j =
    Hashtbl.mem is_edge (min i j, max i j)
    && match turn (Hashtbl.find boxes a) (Hashtbl.find boxes i) (Hashtbl.find boxes j) with Zpos _ -> true | _ -> false
  in
  let triangles = ref [] and fans = ref [] in
  Hashtbl.iter
    (fun a near ->
      let n = Array.length near in
      let follow k = closes a near.(k) near.((k + 1) mod n) in
      let gaps = List.filter (fun k -> not (follow k)) (List.init n Fun.id) in
      for k = 0 to n - 1 do
        let i = near.(k) and j = near.((k + 1) mod n) in
        if a < i && a < j && follow k then triangles := { ta = of_int a; tb = of_int i; tc = of_int j } :: !triangles
      done;
      let from first = List.init n (fun k -> of_int near.((first + k) mod n)) in
      match gaps with
      | [] -> fans := { centre = of_int a; spokes = from 0; whole = true } :: !fans
      | [ k ] -> fans := { centre = of_int a; spokes = from (k + 1); whole = false } :: !fans
      | _ -> ())
    around;
  (!triangles, !fans)

let completeness d e sites edges corners =
  let boxes = Hashtbl.create 1000 in
  Option.iter (List.iter (fun b -> Hashtbl.replace boxes (to_int b.box_name) b)) (scaled_sites d e sites);
  let triangles, fans = hints boxes edges in
  let found = surrounded d e sites edges triangles corners fans in
  Printf.sprintf "%d surrounded%s" (List.length found) (if all_surrounded sites found then ", complete" else "")

(* ---- all ---- *)

let verdict name =
  let channel = open_in_bin name in
  let answer =
    try
      let sites, edges, corners, diagram = read_certificate channel in
      let d, e = unit_of sites edges in
      let good = check d e sites edges in
      Printf.printf "%s: %s, %d sites, %d legal pairs%s\n%!" name
        (if good then "accepted" else "rejected")
        (List.length sites) (List.length edges)
        ((if good then (if diagram then ", diagram not checked, " else ", ") ^ completeness d e sites edges corners
          else ""));
      good
    with Bad _ | Failure _ | Invalid_argument _ | Not_found | Sys_error _ ->
      Printf.printf "%s: rejected, no certificate\n" name;
      false
  in
  close_in channel;
  answer

let () = exit (if List.for_all Fun.id (List.map verdict (List.tl (Array.to_list Sys.argv))) then 0 else 1)
