(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Where the farthest point of a rectangle A is as far as the nearest point of another one, B, in a pane: a stretch of a
   line or of a parabola [ARC-1]. *)
From Coq Require Import Reals Lra Psatz.
From Dyadel Require Import Plane Distance Bisector.
Open Scope R_scope.

(* ---- one axis ---- *)

(* With any two numbers it holds all between them; m is not strictly inside. *)
Definition unbroken (I : R -> Prop) : Prop := forall a b c, a <= b <= c -> I a -> I c -> I b.
Definition uncut (m : R) (I : R -> Prop) : Prop := (forall t, I t -> t <= m) \/ (forall t, I t -> m <= t).

(* What an axis adds to dl_A^2 - ds_B^2. *)
Definition share (al ah bl bh t : R) : R :=
  (t - far_end al ah t) * (t - far_end al ah t) - (t - clamp bl bh t) * (t - clamp bl bh t).

(* A pane is cut at the middle of A, but where neither has extent, and at the ends of B, but where they are one. *)
Definition pane (al ah bl bh : R) (I : R -> Prop) : Prop := unbroken I /\
  (uncut ((al + ah) / 2) I \/ al = ah /\ bl = bh) /\ (bl = bh \/ uncut bl I /\ uncut bh I).

(* Seen from all of I the farthest end is s, and the nearest place the end q, *)
Definition to_end (al ah bl bh : R) (I : R -> Prop) (s q : R) : Prop := (s = al \/ s = ah) /\ (q = bl \/ q = bh) /\
  (forall t, I t -> share al ah bl bh t = (q - s) * (2 * t - q - s)) /\
  (forall t, I t -> t = bl \/ t = bh -> t = q).

(* or the side that one looks from; s is on one side of I then. *)
Definition to_side (al ah bl bh : R) (I : R -> Prop) (s : R) : Prop := (s = al \/ s = ah) /\
  (forall t, I t -> bl <= t <= bh /\ share al ah bl bh t = (t - s) * (t - s)) /\ uncut s I.

Lemma pane_cases al ah bl bh I : al <= ah -> bl <= bh -> pane al ah bl bh I ->
  exists s, (exists q, to_end al ah bl bh I s q) \/ to_side al ah bl bh I s.
Proof.
  intros A B (_ & M & C).
  assert (S : exists s, (s = al \/ s = ah) /\ (forall t, I t -> (t - far_end al ah t) * (t - far_end al ah t) =
    (t - s) * (t - s)) /\ (uncut s I \/ bl = bh)).
  { destruct M as [[L | L] | [-> ->]].
    - exists ah. split; [tauto |]. split; [| left; left; intros t T; specialize (L t T); lra].
      intros t T. specialize (L t T). unfold far_end. destruct (Rle_dec _ _); [| reflexivity].
      replace t with ((al + ah) / 2) by lra. field.
    - exists al. split; [tauto |]. split; [| left; right; intros t T; specialize (L t T); lra].
      intros t T. specialize (L t T). unfold far_end. destruct (Rle_dec _ _); [reflexivity | lra].
    - exists ah. split; [tauto |]. split; [| now right]. intros t T. unfold far_end. now destruct (Rle_dec _ _). }
  destruct S as (s & End & Far & One). exists s.
  assert (Q : forall q, q = bl \/ q = bh -> (forall t, I t -> clamp bl bh t = q) -> (forall t, I t -> t = bl \/ t = bh ->
    t = q) -> exists q, to_end al ah bl bh I s q).
  { intros q Eq N Edge. exists q. repeat split; auto. intros t T. unfold share. rewrite (Far t T), (N t T). ring. }
  unfold clamp in Q. unfold Rmax, Rmin in Q.
  destruct C as [E | [Lo Hi]].
  - left. apply (Q bl); [tauto | |]; intros t T.
    + destruct (Rle_dec bh t); destruct (Rle_dec bl _); lra.
    + lra.
  - destruct Lo as [Lo | Lo].
    { left. apply (Q bl); [tauto | |]; intros t T; specialize (Lo t T); [| lra].
      destruct (Rle_dec bh t); destruct (Rle_dec bl _); lra. }
    destruct Hi as [Hi | Hi].
    + destruct One as [One | E]; [right | left].
      * split; [exact End |]. split; [| exact One]. intros t T. specialize (Lo t T). specialize (Hi t T).
        split; [lra |]. unfold share. rewrite (Far t T). unfold clamp, Rmax, Rmin.
        destruct (Rle_dec bh t); destruct (Rle_dec bl _); try lra; replace bh with t by lra; ring.
      * apply (Q bl); [tauto | |]; intros t T; specialize (Lo t T); specialize (Hi t T); [| lra].
        destruct (Rle_dec bh t); destruct (Rle_dec bl _); lra.
    + left. apply (Q bh); [tauto | |]; intros t T; specialize (Hi t T); [| specialize (Lo t T); lra].
      destruct (Rle_dec bh t); destruct (Rle_dec bl _); lra.
Qed.

(* ---- graphs of monotone functions ---- *)

Definition monotone_on (K : R -> Prop) (f : R -> R) : Prop :=
  (forall a b, K a -> K b -> a <= b -> f a <= f b) \/ (forall a b, K a -> K b -> a <= b -> f b <= f a).

(* The part in which K holds of the graph of a continuous function, monotone there, over one of the axes. *)
Definition arc (Z : R -> R -> Prop) : Prop := exists K f, unbroken K /\ continuity f /\ monotone_on K f /\
  ((forall x y, Z x y <-> K x /\ y = f x) \/ (forall x y, Z x y <-> K y /\ x = f y)).

Lemma arc_swap Z : arc (fun x y => Z y x) -> arc Z.
Proof.
  intros (K & f & U & C & M & G). exists K, f. split; [exact U |]. split; [exact C |]. split; [exact M |].
  destruct G as [G | G]; [right | left]; intros x y; apply G.
Qed.

Lemma arc_same (Z Z' : R -> R -> Prop) : (forall x y, Z x y <-> Z' x y) -> arc Z -> arc Z'.
Proof.
  intros E (K & f & U & C & M & G). exists K, f. split; [exact U |]. split; [exact C |]. split; [exact M |].
  destruct G as [G | G]; [left | right]; intros x y; rewrite <- E; apply G.
Qed.

Lemma arc_none (Z : R -> R -> Prop) : (forall x y, ~ Z x y) -> arc Z.
Proof.
  intros N. exists (fun _ => False), (fun _ => 0). split; [intros a b c _ [] |]. split; [apply continuity_const; intros a
    b; reflexivity |]. split; [left; intros a b [] |]. left. intros x y. split; [intros H; elim (N x y H) | tauto].
Qed.

(* The part in J of a monotone continuous function over I. *)
Lemma arc_of_graph I J f (Z : R -> R -> Prop) : unbroken I -> unbroken J -> continuity f -> monotone_on I f ->
  (forall x y, Z x y <-> I x /\ J y /\ y = f x) -> arc Z.
Proof.
  intros Iu Ju C M E. exists (fun x => I x /\ J (f x)), f. split; [| split; [exact C |]; split].
  - intros a b c L [Ia Ja] [Ic Jc]. assert (Ib : I b) by (apply (Iu a b c L Ia Ic)). split; [exact Ib |].
    destruct M as [M | M].
    + apply (Ju (f a) (f b) (f c)); [split; apply M; tauto | exact Ja | exact Jc].
    + apply (Ju (f c) (f b) (f a)); [split; apply M; tauto | exact Jc | exact Ja].
  - destruct M as [M | M]; [left | right]; intros a b [Ia _] [Ib _]; now apply M.
  - left. intros x y. rewrite E. split; [intros (X & Y & ->); auto | intros ((X & Y) & ->); auto].
Qed.

(* ---- both axes ---- *)

Section Pane.
Variables A B : rect.
Variable disjoint : forall z, inside z A -> ~ inside z B.

Lemma lead_shares x y : lead A B x y = share (xlo A) (xhi A) (xlo B) (xhi B) x + share (ylo A) (yhi A) (ylo B) (yhi B) y.
Proof. unfold lead, dl, ds. rewrite !dist_sq. unfold dist2, farthest, nearest, share. cbn [fst snd]. ring. Qed.

Variables I J : R -> Prop.
Variable across : pane (xlo A) (xhi A) (xlo B) (xhi B) I.
Variable along : pane (ylo A) (yhi A) (ylo B) (yhi B) J.

(* Some corner of A is in no side of B. *)
Lemma ends_apart s t q r : s = xlo A \/ s = xhi A -> t = ylo A \/ t = yhi A -> xlo B <= q <= xhi B -> ylo B <= r <= yhi B ->
  s = q -> t = r -> False.
Proof.
  intros S T Q W E F. pose proof (x_ordered A). pose proof (y_ordered A).
  apply (disjoint (s, t)); unfold inside; cbn [fst snd]; subst q r; split; try assumption; lra.
Qed.

Definition Z (x y : R) : Prop := I x /\ J y /\ lead A B x y = 0.

Lemma zero_equal x y : lead A B x y = 0 <-> dl (x, y) A = ds (x, y) B.
Proof. apply lead_sign. Qed.
End Pane.

(* ---- the shapes of the set ---- *)

(* u x + v y = w, not all of the plane. *)
Lemma arc_line I J u v w : unbroken I -> unbroken J -> ~ (u = 0 /\ v = 0) ->
  arc (fun x y => I x /\ J y /\ u * x + v * y = w).
Proof.
  intros Iu Ju N. destruct (Req_dec v 0) as [-> | V].
  - apply arc_swap. assert (U : u <> 0) by (intros ->; apply N; split; reflexivity).
    apply (arc_of_graph J I (fun _ => w / u)); auto; [apply continuity_const; intros a b; reflexivity |
      left; intros; lra |]. intros y x.
    assert (E : u * x + 0 * y = w <-> x = w / u).
    { split; [intros <-; field; exact U | intros ->; field; exact U]. }
    rewrite E. tauto.
  - apply (arc_of_graph I J (fun x => w / v - u / v * x)); auto.
    + apply (continuity_minus (fun _ => w / v) (fun x => u / v * x)); [apply continuity_const; intros a b; reflexivity |].
      apply (continuity_scal (fun x => x)), derivable_continuous, derivable_id.
    + destruct (Rle_or_lt 0 (u / v)) as [S | S]; [right | left]; intros a b _ _ L; nra.
    + intros x y. assert (E : u * x + v * y = w <-> y = w / v - u / v * x).
      { split; [intros <-; field; exact V | intros ->; field; exact V]. }
      rewrite E. tauto.
Qed.

(* (x - s)^2 = h (2 y - c), h not 0, with s on one side. *)
Lemma arc_parabola I J s h c : unbroken I -> unbroken J -> uncut s I -> h <> 0 ->
  arc (fun x y => I x /\ J y /\ (x - s) * (x - s) = h * (2 * y - c)).
Proof.
  intros Iu Ju S H. apply (arc_of_graph I J (fun x => (x - s) * (x - s) * / (2 * h) + c / 2)); auto.
  - apply (continuity_plus (fun x => (x - s) * (x - s) * / (2 * h)) (fun _ => c / 2));
      [| apply continuity_const; intros a b; reflexivity].
    apply (continuity_mult (fun x => (x - s) * (x - s)) (fun _ => / (2 * h)));
      [| apply continuity_const; intros a b; reflexivity].
    assert (D : continuity (fun x => x - s)).
    { apply (continuity_minus (fun x => x) (fun _ => s)); [apply derivable_continuous, derivable_id |
        apply continuity_const; intros a b; reflexivity]. }
    exact (continuity_mult _ _ D D).
  - assert (G : forall k, monotone_on I (fun x => (x - s) * (x - s) * k + c / 2)).
    { intros k. destruct S as [S | S]; destruct (Rle_or_lt 0 k) as [P | P].
      - right. intros a b Ia Ib L. pose proof (S a Ia). pose proof (S b Ib).
        assert ((b - s) * (b - s) <= (a - s) * (a - s)) by nra. nra.
      - left. intros a b Ia Ib L. pose proof (S a Ia). pose proof (S b Ib).
        assert ((b - s) * (b - s) <= (a - s) * (a - s)) by nra. nra.
      - left. intros a b Ia Ib L. pose proof (S a Ia). pose proof (S b Ib).
        assert ((a - s) * (a - s) <= (b - s) * (b - s)) by nra. nra.
      - right. intros a b Ia Ib L. pose proof (S a Ia). pose proof (S b Ib).
        assert ((a - s) * (a - s) <= (b - s) * (b - s)) by nra. nra. }
    apply G.
  - intros x y. assert (E : (x - s) * (x - s) = h * (2 * y - c) <-> y = (x - s) * (x - s) * / (2 * h) + c / 2).
    { split; [intros -> | intros ->]; field; lra. }
    rewrite E. tauto.
Qed.

(* One axis sees the side of B, the other an end. *)
Lemma arc_mixed I J f g s t r : unbroken I -> unbroken J -> uncut s I -> (forall x, I x -> f x = (x - s) * (x - s)) ->
  (forall y, J y -> g y = (r - t) * (2 * y - r - t)) -> (t = r -> ~ I s) ->
  arc (fun x y => I x /\ J y /\ f x + g y = 0).
Proof.
  intros Iu Ju S F G N. destruct (Req_dec t r) as [E | H].
  - apply arc_none. intros x y (X & Y & Zero). rewrite (F x X), (G y Y) in Zero. apply (N E). replace s with x; [exact X |].
    assert (Q : (x - s) * (x - s) = 0) by (subst; lra). apply Rmult_integral in Q. lra.
  - apply (arc_same (fun x y => I x /\ J y /\ (x - s) * (x - s) = (t - r) * (2 * y - (t + r))));
      [| apply arc_parabola; auto; lra].
    intros x y. split; intros (X & Y & Q); split; try split; auto; rewrite (F x X), (G y Y) in *; lra.
Qed.

(* ---- the theorems ---- *)

Section Arcs.
Variables A B : rect.
Variable disjoint : forall z, inside z A -> ~ inside z B.
Variables I J : R -> Prop.
Variable across : pane (xlo A) (xhi A) (xlo B) (xhi B) I.
Variable along : pane (ylo A) (yhi A) (ylo B) (yhi B) J.

Let X_cases := pane_cases _ _ _ _ I (x_ordered A) (x_ordered B) across.
Let Y_cases := pane_cases _ _ _ _ J (y_ordered A) (y_ordered B) along.

Lemma end_within lo hi q : lo <= hi -> q = lo \/ q = hi -> lo <= q <= hi.
Proof. intros L [-> | ->]; lra. Qed.

(* In the pane the centres as far from the farthest point of A as from the nearest of B are one arc or none. *)
Theorem pane_arc : arc (fun x y => I x /\ J y /\ dl (x, y) A = ds (x, y) B).
Proof.
  apply (arc_same (fun x y => I x /\ J y /\ share (xlo A) (xhi A) (xlo B) (xhi B) x +
    share (ylo A) (yhi A) (ylo B) (yhi B) y = 0)).
  { intros x y. rewrite <- zero_equal, lead_shares. tauto. }
  destruct X_cases as (s & [(q & Xs & Xq & Xe & _) | (Xs & Xe & Xu)]);
    destruct Y_cases as (t & [(r & Ys & Yq & Ye & _) | (Ys & Ye & Yu)]).
  - apply (arc_same (fun x y => I x /\ J y /\ (2 * (q - s)) * x + (2 * (r - t)) * y = (q - s) * (q + s) + (r - t) *
      (r + t))).
    + intros x y. split; intros (X & Y & Q); split; try split; auto; rewrite (Xe x X), (Ye y Y) in *; lra.
    + apply arc_line; [apply across | apply along |]. intros [E F]. apply (ends_apart A B disjoint s t q r); auto;
        try lra; apply end_within; auto using x_ordered, y_ordered.
  - apply arc_swap. apply (arc_same (fun y x => J y /\ I x /\ share (ylo A) (yhi A) (ylo B) (yhi B) y +
      share (xlo A) (xhi A) (xlo B) (xhi B) x = 0)); [intros y x; rewrite Rplus_comm; tauto |].
    apply (arc_mixed J I _ _ t s q); auto; try apply along; try apply across; [intros; now apply Ye |].
    intros E T. apply (ends_apart A B disjoint s t q t); auto; [apply end_within; auto using x_ordered | now apply Ye].
  - apply (arc_mixed I J _ _ s t r); auto; try apply along; try apply across; [intros; now apply Xe |].
    intros E T. apply (ends_apart A B disjoint s t s r); auto; [now apply Xe | apply end_within; auto using y_ordered].
  - apply arc_none. intros x y (X & Y & Q). destruct (Xe x X) as [Bx Ex]. destruct (Ye y Y) as [By Ey].
    rewrite Ex, Ey in Q. assert (S : Rsqr (x - s) + Rsqr (y - t) = 0) by exact Q.
    destruct (Rplus_sqr_eq_0 _ _ S). apply (ends_apart A B disjoint s t x y); auto; lra.
Qed.

Lemma share_monotone al ah bl bh K : al <= ah -> bl <= bh -> pane al ah bl bh K -> monotone_on K (share al ah bl bh).
Proof.
  intros La Lb P. destruct (pane_cases al ah bl bh K La Lb P) as (s & [(q & _ & _ & E & _) | (_ & E & [U | U])]).
  - destruct (Rle_or_lt 0 (q - s)) as [D | D]; [left | right]; intros a b Ka Kb L; rewrite (E a Ka), (E b Kb); nra.
  - right. intros a b Ka Kb L. destruct (E a Ka) as [_ ->]. destruct (E b Kb) as [_ ->]. pose proof (U a Ka). pose proof
      (U b Kb). nra.
  - left. intros a b Ka Kb L. destruct (E a Ka) as [_ ->]. destruct (E b Kb) as [_ ->]. pose proof (U a Ka). pose proof
      (U b Kb). nra.
Qed.

(* dl_A^2 - ds_B^2 rises or falls in each coordinate, all over the pane. *)
Theorem lead_monotone : (forall y, monotone_on I (fun x => lead A B x y)) /\ forall x, monotone_on J (lead A B x).
Proof.
  split.
  - intros y. destruct (share_monotone _ _ _ _ I (x_ordered A) (x_ordered B) across) as [M | M]; [left | right];
      intros a b Ka Kb L; rewrite !lead_shares; specialize (M a b Ka Kb L); lra.
  - intros x. destruct (share_monotone _ _ _ _ J (y_ordered A) (y_ordered B) along) as [M | M]; [left | right];
      intros a b Ka Kb L; rewrite !lead_shares; specialize (M a b Ka Kb L); lra.
Qed.

(* ---- at the border, and at ends ---- *)

(* Two of one row differ in both coordinates, or the row is none that panes are cut at. *)
Theorem row_once x y y' : I x -> J y -> J y' -> lead A B x y = 0 -> lead A B x y' = 0 ->
  x = (xlo A + xhi A) / 2 \/ x = xlo B \/ x = xhi B -> y = y'.
Proof.
  intros X Y Y' Q Q' Cut. rewrite lead_shares in Q, Q'. pose proof (x_ordered B) as Ox. pose proof (y_ordered B) as Oy.
  destruct Y_cases as (t & [(r & Ys & Yq & Ye & _) | (Ys & Ye & Yu)]).
  - rewrite (Ye y Y) in Q. rewrite (Ye y' Y') in Q'. destruct (Req_dec r t) as [E | N].
    2: { apply Rmult_eq_reg_l with (r - t); lra. }
    exfalso. assert (W : ylo B <= t <= yhi B) by (subst r; apply end_within; auto).
    destruct X_cases as (s & [(q & Xs & Xq & Xe & Edge) | (Xs & Xe & _)]).
    + rewrite (Xe x X) in Q. assert (D : (q - s) * (2 * x - q - s) = 0) by (subst r; lra).
      pose proof (end_within _ _ q Ox Xq) as Qin. apply Rmult_integral in D. destruct D as [D | D];
        [apply (ends_apart A B disjoint s t q t); auto; lra |].
      destruct Cut as [M | Cut].
      * apply (ends_apart A B disjoint (xlo A + xhi A - s) t q t); auto; [destruct Xs as [-> | ->]; [right | left]; ring |
          lra].
      * rewrite (Edge x X Cut) in D. apply (ends_apart A B disjoint s t q t); auto; lra.
    + destruct (Xe x X) as [Bx Ex]. rewrite Ex in Q. assert (D : (x - s) * (x - s) = 0) by (subst r; lra).
      apply Rmult_integral in D. apply (ends_apart A B disjoint s t x t); auto; lra.
  - destruct (Ye y Y) as [_ E]. destruct (Ye y' Y') as [_ E']. rewrite E in Q. rewrite E' in Q'.
    assert (D : (y - y') * ((y - t) + (y' - t)) = 0) by lra. apply Rmult_integral in D. destruct D as [D | D]; [lra |].
    destruct Yu as [U | U]; pose proof (U y Y); pose proof (U y' Y'); lra.
Qed.

(* What the set is, in numbers that are coordinates of corners: a line, or a parabola over one of the axes. Of one
   coordinate the other is a fraction, or a sum or difference of a fraction and a root of one. *)
Theorem pane_numbers : exists s t q r, (s = xlo A \/ s = xhi A) /\ (t = ylo A \/ t = yhi A) /\ xlo B <= q <= xhi B /\
  ylo B <= r <= yhi B /\
  ((forall x y, I x -> J y -> (lead A B x y = 0 <-> 2 * (q - s) * x + 2 * (r - t) * y = q * q - s * s + r * r - t * t)) \/
   (forall x y, I x -> J y -> (lead A B x y = 0 <-> (x - s) * (x - s) = (t - r) * (2 * y - r - t))) \/
   (forall x y, I x -> J y -> (lead A B x y = 0 <-> (y - t) * (y - t) = (s - q) * (2 * x - q - s))) \/
   forall x y, I x -> J y -> lead A B x y <> 0).
Proof.
  pose proof (x_ordered B) as Ox. pose proof (y_ordered B) as Oy.
  destruct X_cases as (s & [(q & Xs & Xq & Xe & _) | (Xs & Xe & Xu)]);
    destruct Y_cases as (t & [(r & Ys & Yq & Ye & _) | (Ys & Ye & Yu)]).
  - exists s, t, q, r. do 4 (split; [auto using end_within |]). left. intros x y X Y. rewrite lead_shares, (Xe x X), (Ye y
      Y). split; intros; lra.
  - exists s, t, q, (ylo B). do 3 (split; [auto using end_within |]). split; [lra |]. right. right. left. intros x y X Y.
    destruct (Ye y Y) as [_ E]. rewrite lead_shares, (Xe x X), E. split; intros; lra.
  - exists s, t, (xlo B), r. do 2 (split; [auto |]). split; [lra |]. split; [now apply end_within |]. right. left. intros x
      y X Y. destruct (Xe x X) as [_ E]. rewrite lead_shares, E, (Ye y Y). split; intros; lra.
  - exists s, t, (xlo B), (ylo B). do 2 (split; [auto |]). do 2 (split; [lra |]). do 3 right. intros x y X Y Q.
    destruct (Xe x X) as [Bx Ex]. destruct (Ye y Y) as [By Ey]. rewrite lead_shares, Ex, Ey in Q.
    destruct (Rplus_sqr_eq_0 _ _ Q). apply (ends_apart A B disjoint s t x y); auto; lra.
Qed.
End Arcs.

Lemma root_or_minus s x w : 0 <= w -> ((x - s) * (x - s) = w <-> x = s + sqrt w \/ x = s - sqrt w).
Proof.
  intros W. pose proof (sqrt_sqrt w W) as S. split; [intros E | intros [-> | ->]; lra].
  assert (D : (x - s - sqrt w) * (x - s + sqrt w) = 0) by lra. apply Rmult_integral in D. destruct D; [left | right]; lra.
Qed.

Lemma flip_inside x y B : inside (y, x) (flip B) <-> inside (x, y) B.
Proof. unfold inside. cbn. tauto. Qed.

(* The same of a column. *)
Theorem column_once A B I J : (forall z, inside z A -> ~ inside z B) -> pane (xlo A) (xhi A) (xlo B) (xhi B) I ->
  pane (ylo A) (yhi A) (ylo B) (yhi B) J -> forall x x' y, I x -> I x' -> J y -> lead A B x y = 0 -> lead A B x' y = 0 ->
  y = (ylo A + yhi A) / 2 \/ y = ylo B \/ y = yhi B -> x = x'.
Proof.
  intros Off Px Py x x' y X X' Y Q Q' Cut. apply (row_once (flip A) (flip B)) with (I := J) (J := I) (x := y); auto.
  - intros [v u]. rewrite !flip_inside. apply Off.
  - rewrite lead_shares in Q |- *. cbn. lra.
  - rewrite lead_shares in Q' |- *. cbn. lra.
Qed.
