(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The fifth part of the checker of certificates: chains. CheckerChainSound.v says what follows from one that holds: no
   centre on it is possibly nearest to one of the two sites, and their pair is illegal. The theorem on the whole
   certificate needs no chain, see CheckerCover.v; a certificate with a chain that does not hold is still refused. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Import Checker CheckerCover.
Import ListNotations.
Open Scope Z_scope.

(* A direction, blocker and point by turns, a blocker, a direction. *)
Record chain : Type := Chain { one : Z; other : Z; first_way : number * number; links : list (Z * (number * number));
                               last_blocker : Z; last_way : number * number }.

Definition spot_of (D E w : Z) (at_ : number * number) : option spot :=
  match scaled D E (fst at_), scaled D E (snd at_) with Some x, Some y => Some (Spot x y w) | _, _ => None end.

(* A part of a chain: its blocker and its ends. *)
Record piece : Type := Piece { blocker_name : Z; from_spot : spot; to_spot : spot }.

Fixpoint pieces (D E : Z) (a : spot) (l : list (Z * (number * number))) (k : Z) (last : spot) : option (list piece) :=
  match l with
  | [] => Some [Piece k a last]
  | (j, p) :: rest =>
    match spot_of D E 1 p with
    | Some b => match pieces D E b rest k last with Some more => Some (Piece j a b :: more) | None => None end
    | None => None
    end
  end.

Definition blocks (m : Map.t box) (i j : box) (p : piece) : bool :=
  let a := from_spot p in let b := to_spot p in
  match Map.find (blocker_name p) m with
  | Some k =>
    (0 <=? sw a) && (0 <=? sw b) && (far a k <? near a i) && (far a k <? near a j) && (far b k <? near b i) &&
    (far b k <? near b j)
  | None => false
  end.

(* Does a piece cross the segment between two lower left corners? Points of its line count as left of it. *)
Definition cross (ux uy vx vy : Z) : Z := ux * vy - uy * vx.

Definition turn_to (p q : box) (g : spot) : Z :=
  let w := sw g in cross (x0 q - x0 p) (y0 q - y0 p) (sx g - w * x0 p) (sy g - w * y0 p).

Definition is_apart (p q : box) (a b : spot) : bool :=
  let s := turn_to p q a in let t := turn_to p q b in
  negb ((sw a =? 0) && (s =? 0)) && negb ((sw b =? 0) && (t =? 0)) && xorb (0 <=? s) (0 <=? t).

Definition is_met (p q : box) (a b : spot) : bool :=
  let o := if sw a =? 0 then b else a in
  let vx := if sw a =? 0 then sx a else sx b - sw b * sx a in let vy := if sw a =? 0 then sy a else sy b - sw b * sy a in
  cross vx vy (x0 p - sx o) (y0 p - sy o) * cross vx vy (x0 q - sx o) (y0 q - sy o) <? 0.

Definition crosses (p q : box) (k : piece) : bool :=
  let a := from_spot k in let b := to_spot k in is_apart p q a b && is_met p q a b.

Definition is_chain (m : Map.t box) (i j : box) (l : list piece) : bool :=
  forallb (blocks m i j) l && fold_left (fun odd k => xorb odd (crosses i j k)) l false.

Definition chain_pieces (D E : Z) (c : chain) : option (list piece) :=
  match links c, spot_of D E 0 (first_way c), spot_of D E 0 (last_way c) with
  | _ :: _, Some a, Some b => pieces D E a (links c) (last_blocker c) b
  | _, _, _ => None
  end.

(* The chains that do not hold. *)
Definition broken_chains (D E : Z) (sites : list site) (chains : list chain) : list chain :=
  match scaled_sites D E sites with
  | Some boxes =>
    let m := index box_name boxes in
    kept (fun c =>
      match Map.find (one c) m, Map.find (other c) m, chain_pieces D E c with
      | Some i, Some j, Some l => negb (is_chain m i j l)
      | _, _, _ => true
      end) chains
  | None => chains
  end.
