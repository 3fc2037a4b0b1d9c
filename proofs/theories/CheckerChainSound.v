(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A chain that holds: no centre on it is possibly nearest to one of its two sites, and their pair is not possible. *)
From Coq Require Import Reals Lra Lia ZArith List Bool.
From Dyadel Require Import Plane Distance Cells Nerve Orientation Separated SeparatedSites.
From Dyadel Require Import Checker CheckerSound CheckerFaces CheckerComplete CheckerCover CheckerCoverSound
  CheckerChain.
Import ListNotations.
Open Scope R_scope.

(* z is a centre of the piece: a sum of its two ends by weights. *)
Definition on_piece (z : triple) (p : piece) : Prop :=
  in_triangle z (of_spot (from_spot p)) (of_spot (to_spot p)) (of_spot (to_spot p)).

Lemma exact_bounds S b A : is_box S b A -> 0 < S -> bounds S b A.
Proof.
  intros (X0 & X1 & Y0 & Y1) P x [X Y]. rewrite X0, X1, Y0, Y1. repeat split; rewrite (Rmult_comm S);
    apply Rmult_le_compat_r; lra.
Qed.

(* The facts known of a chain that is not among the broken ones. *)
Lemma kept_chain D E l edges B chains c a b :
  check D E l edges = true -> describes l B -> In c chains -> ~ In c (broken_chains D E l chains) ->
  named l a (one c) -> named l b (other c) -> exists bs i j t, scaled_sites D E l = Some bs /\ 0 < unit D E /\
    ((a < length l)%nat /\ (b < length l)%nat) /\ (is_box (unit D E) i (B a) /\ is_box (unit D E) j (B b)) /\
    chain_pieces D E c = Some t /\ is_chain (index box_name bs) i j t = true.
Proof.
  intros C F I H A G. destruct (accepted_parts D E l edges C) as (bs & Sc & P0 & R0 & _).
  unfold broken_chains in H. rewrite Sc in H. cbv zeta in H.
  destruct (named_box D E l edges B C F bs Sc a _ A) as (ba & _ & Fa & _ & Pa).
  destruct (named_box D E l edges B C F bs Sc b _ G) as (bb & _ & Fb & _ & Pb).
  match type of H with ~ In c (kept ?f chains) => destruct (f c) eqn:K; [destruct H; now apply in_kept |] end.
  clear H. cbv beta in K. destruct (Map.find (one c) _) as [i |] eqn:Mi; [| discriminate].
  destruct (Map.find (other c) _) as [j |] eqn:Mj; [| discriminate].
  apply (sought_box D E l edges C bs Sc) in Mi, Mj. assert (i = ba) by congruence. assert (j = bb) by congruence.
  subst i j. destruct (found_named D E l edges B C F bs Sc _ _ Fa) as [_ Ka].
  destruct (found_named D E l edges B C F bs Sc _ _ Fb) as [_ Kb].
  destruct (found_box D E l edges B C F bs Sc _ _ Fa) as [Ba _].
  destruct (found_box D E l edges B C F bs Sc _ _ Fb) as [Bb _]. rewrite Pa in Ka, Ba. rewrite Pb in Kb, Bb.
  destruct (chain_pieces D E c) as [t |]; [| discriminate]. apply negb_false_iff in K.
  exists bs, ba, bb, t. pose proof (unit_pos D E P0). tauto.
Qed.

Theorem chain_avoids D E l edges B chains c a b q p z :
  check D E l edges = true -> describes l B -> In c chains -> ~ In c (broken_chains D E l chains) ->
  named l a (one c) -> named l b (other c) -> chain_pieces D E c = Some q -> In p q -> on_piece z p ->
  ~ allows (length l) (unit D E) B z a /\ ~ allows (length l) (unit D E) B z b.
Proof.
  intros C F I H A G Q P T.
  destruct (kept_chain D E l edges B chains c a b C F I H A G) as (bs & i & j & t & Sc & U & _ & (Bi & Bj) & Q' & K).
  assert (t = q) by congruence. subst t. apply andb_true_iff in K. destruct K as [K _].
  rewrite forallb_forall in K. specialize (K p P). unfold blocks in K. cbv zeta in K.
  destruct (Map.find (blocker_name p) _) as [k |] eqn:Mk; [| discriminate].
  apply (sought_box D E l edges C bs Sc) in Mk. rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt in K.
  destruct K as [[[[[Wa Wb] Ai] Aj] Ci] Cj].
  destruct (found_named D E l edges B C F bs Sc _ _ Mk) as [_ Kn].
  destruct (found_box D E l edges B C F bs Sc _ _ Mk) as [Bk _]. apply exact_bounds in Bk, Bi, Bj; try exact U.
  split; intros Al; apply (Al _ Kn); unfold on_piece in T; (eapply beats_convex; [| | | exact T]); eapply spot_beats;
    eassumption.
Qed.

(* ---- spots as points and directions ---- *)

Section Spots.
Variable S : R.
Variable positive : 0 < S.

Definition place (g : spot) : point := (IZR (sx g) / S, IZR (sy g) / S).
Definition way (g : spot) : point := (IZR (sx g), IZR (sy g)).
Definition low_left (b : box) : point := (IZR (x0 b) / S, IZR (y0 b) / S).

Lemma low_left_inside b A : is_box S b A -> inside (low_left b) A.
Proof.
  intros (X0 & _ & Y0 & _). pose proof (x_ordered A). pose proof (y_ordered A). unfold inside, low_left. simpl.
  rewrite X0, Y0. unfold Rdiv. rewrite !Rmult_assoc, !Rinv_r, !Rmult_1_r by lra. lra.
Qed.

Lemma beats_place g A C : sw g = 1%Z -> beats S (of_spot g) A C -> dl (place g) A < ds (place g) C.
Proof.
  intros W H. specialize (H _ _ (farthest_inside (place g) A) (nearest_inside (place g) C)).
  apply nearer_dist in H; [exact H | exact positive | unfold of_spot; simpl; now rewrite W].
Qed.

Lemma beats_way g A C x y : sw g = 0%Z -> beats S (of_spot g) A C -> inside y A -> inside x C -> dot (way g) x < dot
  (way g) y.
Proof.
  intros W H Y X. specialize (H y x Y X). unfold level, of_spot in H. cbn [tx ty tw fst snd] in H. rewrite W in H.
  apply (Rmult_lt_reg_l S); [exact positive |]. unfold dot, way. cbn [fst snd]. lra.
Qed.

Lemma turn_place p q g : sw g = 1%Z -> IZR (turn_to p q g) = S * S * orient (low_left p) (low_left q) (place g).
Proof.
  intros W. unfold turn_to, cross. cbv zeta. rewrite W, !Z.mul_1_l, minus_IZR, !mult_IZR, !minus_IZR.
  unfold orient, low_left, place. simpl. field. lra.
Qed.

Lemma turn_way p q g : sw g = 0%Z -> IZR (turn_to p q g) = S * turning (minus (low_left q) (low_left p)) (way g).
Proof.
  intros W. unfold turn_to, cross. cbv zeta. rewrite W, !Z.mul_0_l, !Z.sub_0_r, minus_IZR, !mult_IZR, !minus_IZR.
  unfold turning, minus, low_left, way. simpl. field. lra.
Qed.

Lemma sign_same f x r : 0 < f -> IZR x = f * r -> (0 <=? x)%Z = if Rle_dec 0 r then true else false.
Proof.
  intros F E. destruct (Z.leb_spec 0 x) as [H | H], (Rle_dec 0 r) as [K | K]; try reflexivity; exfalso.
  - apply IZR_le in H. apply K. apply (Rmult_le_reg_l f); [exact F | lra].
  - apply IZR_lt in H. assert (0 <= f * r) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma opposite_same f x y r s : 0 < f -> IZR x = f * r -> IZR y = f * s -> (x * y <? 0)%Z = opposite r s.
Proof.
  intros F X Y. unfold opposite. assert (E : IZR (x * y) = f * f * (r * s)) by (rewrite mult_IZR, X, Y; ring).
  assert (Q : 0 < f * f) by (apply Rmult_lt_0_compat; exact F).
  destruct (Z.ltb_spec (x * y) 0) as [H | H], (Rlt_dec (r * s) 0) as [K | K]; try reflexivity; exfalso.
  - apply IZR_lt in H. apply K. apply (Rmult_lt_reg_l (f * f)); [exact Q | lra].
  - apply IZR_le in H. apply (Rmult_lt_compat_l (f * f)) in K; [lra | exact Q].
Qed.

Lemma left_same p q g : sw g = 1%Z -> (0 <=? turn_to p q g)%Z = is_left (low_left p) (low_left q) (place g).
Proof. intros W. apply (sign_same (S * S)); [now apply Rmult_lt_0_compat | now apply turn_place]. Qed.

Lemma link_crosses p q k a b : sw a = 1%Z -> sw b = 1%Z ->
  CheckerChain.crosses p q (Piece k a b) = Separated.crosses (low_left p) (low_left q) (place a) (place b).
Proof.
  intros A C. unfold CheckerChain.crosses, Separated.crosses, is_apart, is_met. cbn [from_spot to_spot]. cbv zeta.
  rewrite !left_same by assumption. rewrite A, C. cbn [Z.eqb andb negb]. f_equal.
  apply (opposite_same (S * S)); [now apply Rmult_lt_0_compat | |]; unfold cross;
    rewrite !Z.mul_1_l, minus_IZR, !mult_IZR, !minus_IZR;
    unfold orient, low_left, place; simpl; field; lra.
Qed.

Lemma zero_same p q g : sw g = 0%Z ->
  (turn_to p q g =? 0)%Z = if Req_EM_T (turning (minus (low_left q) (low_left p)) (way g)) 0 then true else false.
Proof.
  intros W. pose proof (turn_way p q g W) as E.
  destruct (Z.eqb_spec (turn_to p q g) 0) as [Z0 | Z0], (Req_EM_T (turning (minus (low_left q) (low_left p)) (way g))
    0) as [T | T];
    try reflexivity; exfalso.
  - rewrite Z0 in E. symmetry in E. apply Rmult_integral in E. destruct E; [lra | contradiction].
  - rewrite T, Rmult_0_r in E. now apply eq_IZR in E.
Qed.

Lemma ray_is_apart p q a b : sw a = 0%Z -> sw b = 1%Z -> is_apart p q a b =
  if Req_EM_T (turning (minus (low_left q) (low_left p)) (way a)) 0 then false
  else xorb (is_left (low_left p) (low_left q) (place b)) (if Rle_dec 0 (turning (minus (low_left q) (low_left p))
    (way a)) then true else false).
Proof.
  intros A C. unfold is_apart. cbv zeta. rewrite A, C, (zero_same p q a A), (left_same p q b C), (sign_same S _ _
    positive (turn_way p q a A)).
  cbn [Z.eqb andb negb]. destruct (Req_EM_T _ 0); [reflexivity |]. cbn [negb andb]. apply xorb_comm.
Qed.

Lemma apart_sym p q a b : is_apart p q a b = is_apart p q b a.
Proof. unfold is_apart. cbv zeta. rewrite (xorb_comm (0 <=? turn_to p q a)). f_equal. apply andb_comm. Qed.

Lemma first_crosses p q k a b : sw a = 0%Z -> sw b = 1%Z ->
  CheckerChain.crosses p q (Piece k a b) = ray_crosses (low_left p) (low_left q) (place b) (way a).
Proof.
  intros A C. unfold CheckerChain.crosses, ray_crosses. cbn [from_spot to_spot]. cbv zeta.
  rewrite (ray_is_apart p q a b A C). f_equal. unfold is_met. rewrite A. cbn [Z.eqb]. cbv zeta.
  apply (opposite_same S); [exact positive | |]; unfold cross; rewrite minus_IZR, !mult_IZR, !minus_IZR;
    unfold turning, minus, low_left, place, way; simpl; field; lra.
Qed.

Lemma last_crosses p q k a b : sw a = 1%Z -> sw b = 0%Z ->
  CheckerChain.crosses p q (Piece k a b) = ray_crosses (low_left p) (low_left q) (place a) (way b).
Proof.
  intros A C. unfold CheckerChain.crosses, ray_crosses. cbn [from_spot to_spot]. cbv zeta.
  rewrite apart_sym, (ray_is_apart p q b a C A). f_equal. unfold is_met. rewrite A, C. cbn [Z.eqb]. cbv zeta.
  apply (opposite_same S); [exact positive | |]; unfold cross; rewrite !Z.mul_0_l, !Z.sub_0_r, minus_IZR, !mult_IZR,
    !minus_IZR;
    unfold turning, minus, low_left, place, way; simpl; field; lra.
Qed.
End Spots.

(* ---- the pieces of a chain that holds ---- *)

Section Held.
Variables (D E : Z) (l : list site) (edges : list edge) (B : sites).
Variables (C : check D E l edges = true) (F : describes l B).
Variables (bs : list box).
Variable scale : scaled_sites D E l = Some bs.
Variables (a b : nat) (i j : box).
Variables (Bi : is_box (unit D E) i (B a)) (Bj : is_box (unit D E) j (B b)) (U : 0 < unit D E).
Let p := low_left (unit D E) i.
Let q := low_left (unit D E) j.
Let m := index box_name bs.

Lemma spot_weight w at_ g : spot_of D E w at_ = Some g -> sw g = w.
Proof.
  unfold spot_of. destruct (scaled D E (fst at_)); [| discriminate]. destruct (scaled D E (snd at_)); [| discriminate].
  intros Q. injection Q as <-. reflexivity.
Qed.

Lemma blocker_at t : CheckerChain.blocks m i j t = true -> exists k, (k < length l)%nat /\
  forall g, g = from_spot t \/ g = to_spot t -> (sw g = 1%Z -> beaten B a b k (place (unit D E) g)) /\
    (sw g = 0%Z -> beyond_both B a b k (way g)).
Proof.
  unfold CheckerChain.blocks. cbv zeta. destruct (Map.find (blocker_name t) m) as [k |] eqn:M; [| discriminate].
  rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt. intros [[[[[Wa Wb] Ai] Aj] Ci] Cj].
  apply (sought_box D E l edges C bs scale) in M. destruct (found_named D E l edges B C F bs scale _ _ M) as [_ K].
  destruct (found_box D E l edges B C F bs scale _ _ M) as [Bk _]. set (n := position bs (blocker_name t)) in *.
  exists n. split; [exact K |].
  pose proof (exact_bounds _ _ _ Bk U) as Hk. pose proof (exact_bounds _ _ _ Bi U) as Hi.
    pose proof (exact_bounds _ _ _ Bj U) as Hj.
  assert (G : forall g, g = from_spot t \/ g = to_spot t -> beats (unit D E) (of_spot g) (B n) (B a) /\ beats (unit D
    E) (of_spot g) (B n) (B b)).
  { intros g [-> | ->]; split; eapply spot_beats; eassumption. }
  intros g H. destruct (G g H) as [Ga Gb]. split; intros W.
  - split; now apply beats_place.
  - intros y Y. split; intros x X; [apply (beats_way _ U g _ _ x y W Ga Y X) | apply (beats_way _ U g _ _ x y W Gb Y
    X)].
Qed.

Definition odd_crossings (t : list piece) : bool := fold_right (fun k odd => xorb (CheckerChain.crosses i j k) odd)
  false t.

Lemma odd_folded t s : fold_left (fun odd k => xorb odd (CheckerChain.crosses i j k)) t s = xorb s (odd_crossings t).
Proof.
  revert s. induction t as [| k t IH]; intros s; simpl; [now rewrite xorb_false_r |]. rewrite IH. apply xorb_assoc.
Qed.

Lemma rest_holds rest : forall g k last t, pieces D E g rest k last = Some t -> sw g = 1%Z -> sw last = 0%Z ->
  forallb (CheckerChain.blocks m i j) t = true ->
  exists way_on k1, held (length l) B a b (place (unit D E) g) way_on /\ (k1 < length l)%nat /\
    beaten B a b k1 (foot (place (unit D E) g) way_on) /\ beyond_both B a b k1 (way last) /\
    odd_crossings t = xorb (crossed p q (steps (place (unit D E) g) (stops way_on)))
      (ray_crosses p q (foot (place (unit D E) g) way_on) (way last)).
Proof.
  induction rest as [| [h at_] rest IH]; intros g k last t H G L Ok; simpl in H.
  - injection H as <-. simpl in Ok. rewrite andb_true_r in Ok. destruct (blocker_at _ Ok) as (k1 & K1 & At).
    cbn [from_spot to_spot] in At.
    exists [], k1. split; [exact Logic.I |]. split; [exact K1 |]. split; [now apply (At g (or_introl eq_refl)) |].
    split; [now apply (At last (or_intror eq_refl)) |]. unfold odd_crossings. simpl. rewrite xorb_false_r.
    rewrite (last_crosses (unit D E) U i j k g last G L). unfold p, q. now destruct (ray_crosses _ _ _ _).
  - destruct (spot_of D E 1 at_) as [b' |] eqn:Sb; [| discriminate]. destruct (pieces D E b' rest k last) as [more |]
    eqn:P; [| discriminate].
    injection H as <-. simpl in Ok. apply andb_prop in Ok. destruct Ok as [Ok1 Ok2].
      pose proof (spot_weight _ _ _ Sb) as W.
    destruct (blocker_at _ Ok1) as (n & Kn & At). cbn [from_spot to_spot] in At.
    destruct (IH b' k last more P W L Ok2) as (way_on & k1 & Hw & K1 & Bt & By & Od).
    exists ((n, place (unit D E) b') :: way_on), k1. split.
    { split; [exact Kn |]. split; [now apply (At g (or_introl eq_refl)) |]. split;
      [now apply (At b' (or_intror eq_refl)) | exact Hw]. }
    split; [exact K1 |]. split; [exact Bt |]. split; [exact By |]. unfold odd_crossings in *. simpl. rewrite Od.
    rewrite (link_crosses (unit D E) U i j h g b' G W). fold p q. now rewrite xorb_assoc.
Qed.
End Held.

(* The pair of a chain that holds is not possible. *)
Theorem accepted_chain D E l edges B chains c a b :
  check D E l edges = true -> describes l B -> In c chains -> ~ In c (broken_chains D E l chains) ->
  named l a (one c) -> named l b (other c) -> ~ possible (length l) B a b.
Proof.
  intros C F I H A G.
  destruct (kept_chain D E l edges B chains c a b C F I H A G) as
    (bs & ba & bb & t & Sc & U & (Ka & Kb) & (Ba & Bb) & Q & K).
  unfold is_chain in K. apply andb_prop in K. destruct K as [Ok Odd]. rewrite odd_folded, xorb_false_l in Odd.
  unfold chain_pieces in Q.
  destruct (links c) as [| [h at_] rest]; [discriminate |].
  destruct (spot_of D E 0 (first_way c)) as [u0 |] eqn:S0; [| discriminate].
  destruct (spot_of D E 0 (last_way c)) as [u1 |] eqn:S1; [| discriminate]. simpl in Q.
  destruct (spot_of D E 1 at_) as [g |] eqn:Sg; [| discriminate].
  destruct (pieces D E g rest (last_blocker c) u1) as [more |] eqn:P; [| discriminate]. injection Q as <-.
  apply spot_weight in S0, S1, Sg. simpl in Ok. apply andb_prop in Ok. destruct Ok as [Ok1 Ok2].
  destruct (blocker_at D E l edges B C F bs Sc a b ba bb Ba Bb U _ Ok1) as (k0 & K0 & At).
    cbn [from_spot to_spot] in At.
  destruct (rest_holds D E l edges B C F bs Sc a b ba bb Ba Bb U rest g _ u1 more P Sg S1 Ok2) as (way_on & k1 & Hw &
    K1 & Bt & By & Od).
  apply (separated_impossible (length l) B a b Ka Kb (way u0) k0 (place (unit D E) g) way_on k1 (way u1)) with
    (low_left (unit D E) ba) (low_left (unit D E) bb).
  - split; [| now split]. split; [exact K0 |]. split; [now apply (At g (or_intror eq_refl)) | now apply (At u0
    (or_introl eq_refl))].
  - now apply low_left_inside.
  - now apply low_left_inside.
  - unfold crossings. rewrite <- Od. unfold odd_crossings in *. simpl in Odd.
    now rewrite (first_crosses (unit D E) U ba bb h u0 g S0 Sg) in Odd.
Qed.
